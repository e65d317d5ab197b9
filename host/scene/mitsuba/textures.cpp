// The texture plugins.
#include "host/scene/mitsuba/textures.h"

#include "host/scene/mitsuba/plugin_table.h"
#include "host/scene/mitsuba/properties.h"

namespace parhelion::mitsuba {

namespace {

/// The rows and columns of x and y, and the column that moves.
glm::dmat3 read_to_uv(Properties& p) {
    const glm::dmat4 m = p.transform("to_uv");
    return {m[0][0], m[0][1], 0.0, m[1][0], m[1][1], 0.0, m[3][0], m[3][1], 1.0};
}

TextureFilter read_filter_type(Properties& p) {
    const std::size_t filter =
        p.choice("filter_type", "bilinear", {"bilinear", "nearest", "trilinear", "ewa"});
    if (filter > 1)
        p.note("filter_type", in_quotes(p.text("filter_type", "")) +
                                  " is taken as \"bilinear\"; only the noise of small texels "
                                  "differs");
    return filter == 1 ? TextureFilter::nearest : TextureFilter::bilinear;
}

Texture read_bitmap(Properties& p) {
    BitmapTexture bitmap;
    bitmap.source = read_image(p, "filename");
    bitmap.filter = read_filter_type(p);
    bitmap.wrap =
        static_cast<TextureWrap>(p.choice("wrap_mode", "repeat", {"repeat", "mirror", "clamp"}));
    bitmap.raw = p.boolean("raw", false);
    // How Mitsuba keeps them in memory, and looks them up on a GPU.
    p.choice("format", "auto", {"auto", "variant", "fp16"});
    p.boolean("accel", true);
    return {p.object().id, read_to_uv(p), bitmap};
}

Texture read_checkerboard(Properties& p) {
    const CheckerboardTexture missing;
    const auto read = [&](const char* name, const Rgb& otherwise) {
        return p.color(name, otherwise, SpectrumUse::unbounded);
    };
    return {p.object().id, read_to_uv(p),
            CheckerboardTexture{read("color0", missing.color0), read("color1", missing.color1)}};
}

Texture read_mesh_attribute(Properties& p) {
    MeshAttributeTexture attribute;
    attribute.name = p.required_text("name");
    if (!attribute.name.starts_with("vertex_") && !attribute.name.starts_with("face_"))
        p.refuse_value("name", in_quotes(attribute.name),
                       "a name that begins with vertex_ or face_");
    attribute.scale = p.number("scale", 1.0);
    return {p.object().id, glm::dmat3(1.0), attribute};
}

using TextureReader = Texture (*)(Properties&);

#define TEXTURE_PLUGIN(name, Name) {#name, read_##name},
constexpr PluginTable<TextureReader, texture_kind_count + 1> texture_plugins = {
    {TEXTURES(TEXTURE_PLUGIN){"rawconstant", nullptr}}};

} // namespace

TexelSource read_image(Properties& p, std::string_view name) {
    const std::string file = p.required_text(name);
    const SourceLocation place = p.location_of(name);
    TexelSource image =
        named_at(place, [&] { return open_texels(p.files().file(file, place).string()); });
    image.read = [place, read = std::move(image.read)](std::span<std::byte> to) {
        named_at(place, [&] { read(to); });
    };
    return image;
}

bool is_known_texture(const Object& object) { return has_plugin(texture_plugins, object.plugin); }

double luminance(const Rgb& color) {
    return 0.212671 * color.r + 0.715160 * color.g + 0.072169 * color.b;
}

Texture read_texture(const Document& document, const Object& object,
                     std::vector<std::string>& notes) {
    Properties p(document, object, notes);
    const TextureReader read = find_plugin(texture_plugins, object);
    Texture texture = read(p);
    p.finish();
    return texture;
}

std::optional<Rgb> read_constant_texture(const Document& document, const Object& object,
                                         std::vector<std::string>& notes) {
    if (find_plugin(texture_plugins, object)) return std::nullopt;
    Properties p(document, object, notes);
    const Rgb value = p.required_numbers("value");
    p.finish();
    return value;
}

void check_texture(const Document& document, const Object& object,
                   std::vector<std::string>& notes) {
    if (!read_constant_texture(document, object, notes))
        static_cast<void>(read_texture(document, object, notes));
}

} // namespace parhelion::mitsuba
