// The textures of a scene as the device reads them.
#include "host/flatten/texture_records.h"

#include "host/flatten/attribute_texels.h"
#include "host/flatten/environment_shares.h"
#include "host/flatten/material_records.h"
#include "host/flatten/texture_bounds.h"
#include "host/flatten/texture_mean.h"
#include "host/image/srgb.h"
#include "host/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <map>
#include <string>
#include <utility>

namespace parhelion {
namespace {

const BitmapTexture* bitmap_of(const Texture& texture) {
    return std::get_if<BitmapTexture>(&texture.kind);
}

// As messages call them.
std::string name_of(const BitmapTexture& bitmap) { return bitmap.source.name; }
std::string name_of(const CheckerboardTexture&) { return "a checkerboard"; }
std::string name_of(const MeshAttributeTexture& attribute) { return attribute.name; }
std::string name_of(const Texture& texture) {
    return std::visit([](const auto& kind) { return name_of(kind); }, texture.kind);
}

/// Rows of textures as parameters name them: the same texture has one row, whoever made it.
class Rows {
public:
    int operator()(const TextureUse& use) {
        if (!use) return -1;
        std::vector<int>& alike = by_name_[name_of(*use.texture)];
        auto known = std::find_if(alike.begin(), alike.end(), [&](int row) {
            return textures_[row] == use.texture || *textures_[row] == *use.texture;
        });
        int row = known != alike.end() ? *known : static_cast<int>(textures_.size());
        if (known == alike.end()) {
            alike.push_back(row);
            textures_.push_back(use.texture);
        }
        uses_.emplace_back(row, use);
        return row;
    }
    /// Of what is no surface's: a row of its own.
    int apart(const TextureUse& use) {
        textures_.push_back(use.texture);
        uses_.emplace_back(static_cast<int>(textures_.size()) - 1, use);
        return uses_.back().first;
    }
    const std::vector<std::shared_ptr<const Texture>>& textures() const { return textures_; }
    const std::vector<std::pair<int, TextureUse>>& uses() const { return uses_; }

private:
    std::vector<std::shared_ptr<const Texture>> textures_;
    std::map<std::string, std::vector<int>> by_name_;
    std::vector<std::pair<int, TextureUse>> uses_;
};

/// By reference, lest a std::function copy them.
TextureRow row_of(Rows& rows) {
    return [&rows](const TextureUse& use) { return rows(use); };
}

/// After the words of its parameters: the texture that tilts its normals.
void set_tilt(MaterialTexturesRecord& t, const Tilt& tilt, const SceneFrame& frame, Rows& rows) {
    if (!tilt) return;
    t.tilt = rows(tilt.texture) << TILT_SHIFT | (tilt.of_normals ? TILT_NORMALS : 0) |
             (tilt.flips ? TILT_FLIPS : 0) | (tilt.shadows ? TILT_SHADOWS : 0);
    t.tilt_scale = static_cast<float>(tilt.of_normals ? tilt.scale : tilt.scale * frame.scale);
}

bool looks_at_lights(const Integrator& integrator) {
    return integrator.kind == IntegratorKind::path || integrator.kind == IntegratorKind::direct;
}

/// Views of geometry look at no material.
bool looks_at_materials(const Integrator& integrator) {
    return looks_at_lights(integrator) ||
           std::any_of(integrator.aovs.begin(), integrator.aovs.end(),
                       [](const AovRequest& a) { return a.kind == "albedo"; });
}

/// Values of 16 bits of sRGB become linear when they are read: floats have room for them.
bool decoded_when_read(const BitmapTexture& bitmap) {
    const TexelLayout& layout = bitmap.source.layout;
    return layout.srgb && !bitmap.raw && layout.component == TexelComponent::single;
}

/// An image, which several textures may look at.
struct ImageTexels {
    const BitmapTexture* bitmap;
    std::size_t first; ///< word

    std::size_t words() const { return (bitmap->source.layout.bytes() + 3) / 4; }
    std::span<std::byte> in(LargeVector<int>& texels) const {
        return std::as_writable_bytes(std::span(texels))
            .subspan(4 * first, bitmap->source.layout.bytes());
    }
};

/// One behind the other, and of each texture which it looks at; -1: none.
struct Images {
    std::vector<ImageTexels> images;
    std::vector<int> of_row;
};

/// Components are read three at a time, of a last grey texel as well.
constexpr std::size_t spare_words = 3;

/// Bytes have numbers of 32 bits, those that are read behind the last as well.
void check_words(const Scene& scene, std::size_t words) {
    constexpr std::size_t most = (std::size_t{1} << 30) - spare_words;
    if (words > most)
        throw InputError(fmt::format("{}: its textures hold {} bytes; the device reads at most {}",
                                     scene.file, 4 * words, 4 * most));
}

Images place_images(const Scene& scene, const Rows& rows) {
    Images placed;
    std::map<std::pair<std::string, bool>, int> known;
    std::size_t end = 0;
    for (const auto& texture : rows.textures()) {
        const BitmapTexture* bitmap = bitmap_of(*texture);
        placed.of_row.push_back(-1);
        if (!bitmap) continue;
        auto [entry, added] = known.try_emplace({bitmap->source.name, decoded_when_read(*bitmap)},
                                                static_cast<int>(placed.images.size()));
        placed.of_row.back() = entry->second;
        if (!added) continue;
        placed.images.push_back({bitmap, end});
        end += placed.images.back().words();
    }
    check_words(scene, end);
    return placed;
}

void read_image(const ImageTexels& image, LargeVector<int>& texels) {
    std::span<std::byte> bytes = image.in(texels);
    image.bitmap->source.read(bytes);
    if (!decoded_when_read(*image.bitmap)) return;
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(float)) {
        float value = 0;
        std::memcpy(&value, &bytes[at], sizeof value);
        value = static_cast<float>(srgb_decode(value));
        std::memcpy(&bytes[at], &value, sizeof value);
    }
}

/// Of several that are broken the first is told of.
void read_images(const std::vector<ImageTexels>& images, LargeVector<int>& texels) {
    if (images.empty()) return;
    std::size_t words = images.back().first + images.back().words();
    texels.resize(words + spare_words);
    std::fill_n(texels.end() - spare_words, spare_words, 0);
    std::vector<std::exception_ptr> errors(images.size());
    parallel_for(images.size(), [&](std::size_t n) {
        try {
            read_image(images[n], texels);
        } catch (...) {
            errors[n] = std::current_exception();
        }
    });
    for (const std::exception_ptr& error : errors)
        if (error) std::rethrow_exception(error);
}

int form_of(const BitmapTexture& bitmap) {
    const TexelLayout& layout = bitmap.source.layout;
    bool linear = bitmap.raw || !layout.srgb;
    return texture_bitmap | (bitmap.filter == TextureFilter::nearest ? TEXTURE_NEAREST : 0) |
           static_cast<int>(bitmap.wrap) << TEXTURE_WRAP_SHIFT |
           (layout.channels == 1 ? TEXTURE_GREY : 0) |
           static_cast<int>(layout.component) << TEXTURE_COMPONENT_SHIFT |
           (linear ? TEXTURE_LINEAR : 0);
}

void set_kind(TextureRecord& t, const BitmapTexture& bitmap, const ImageTexels* image) {
    t.form = form_of(bitmap);
    t.width = bitmap.source.layout.width;
    t.height = bitmap.source.layout.height;
    t.first = static_cast<int>(image->first);
}

void set_kind(TextureRecord& t, const CheckerboardTexture& board, const ImageTexels*) {
    t.form = texture_checkerboard;
    const Rgb &a = board.color0, &b = board.color1;
    t.r0 = static_cast<float>(a.r), t.g0 = static_cast<float>(a.g), t.b0 = static_cast<float>(a.b);
    t.r1 = static_cast<float>(b.r), t.g1 = static_cast<float>(b.g), t.b1 = static_cast<float>(b.b);
}

/// Its words are added behind the images.
void set_kind(TextureRecord& t, const MeshAttributeTexture& attribute, const ImageTexels*) {
    t.form = texture_mesh_attribute | (attribute.of_faces() ? TEXTURE_OF_FACES : 0);
}

TextureRecord texture_record(const Texture& texture, const ImageTexels* image) {
    TextureRecord t{};
    const glm::dmat3& m = texture.to_uv;
    t.ux = static_cast<float>(m[0][0]), t.vx = static_cast<float>(m[0][1]);
    t.uy = static_cast<float>(m[1][0]), t.vy = static_cast<float>(m[1][1]);
    t.ut = static_cast<float>(m[2][0]), t.vt = static_cast<float>(m[2][1]);
    std::visit([&](const auto& kind) { set_kind(t, kind, image); }, texture.kind);
    return t;
}

/// Values that a parameter would be refused with as constants.
void check_values(const Rows& rows, const std::vector<ValueBounds>& bounds) {
    for (const auto& [row, use] : rows.uses()) {
        const auto [lowest, highest] = bounds[row];
        if (placed(use.domain, lowest) && placed(use.domain, highest)) continue;
        throw InputError(fmt::format("{}: {} gets values from {} to {} of {} (accepted: {})",
                                     use.location.to_string(), use.parameter, lowest, highest,
                                     name_of(*use.texture), accepted_text(use.domain)));
    }
}

/// Between which values each texture stays, but for attributes of meshes.
std::vector<ValueBounds> bounds_of(const Rows& rows, const Images& images,
                                   LargeVector<int>& texels) {
    std::vector<ValueBounds> bounds(rows.textures().size());
    parallel_for(bounds.size(), [&](std::size_t row) {
        int image = images.of_row[row];
        std::span<const std::byte> seen;
        if (image >= 0) seen = images.images[image].in(texels);
        bounds[row] = texture_bounds(*rows.textures()[row], seen);
    });
    return bounds;
}

/// Behind what stands in `texels`, and then as many words to spare.
void add_attribute(const Scene& scene, const MeshAttributeTexture& attribute, int row,
                   DeviceScene& out, std::vector<ValueBounds>& bounds) {
    std::size_t first = std::max(out.texels.size(), spare_words) - spare_words;
    AttributeTexels added = attribute_texels(scene, out, attribute, row, first);
    std::size_t table = first + added.values.size(), end = table + added.shapes.size();
    check_words(scene, end);
    out.texels.resize(end + spare_words);
    if (!added.values.empty())
        std::memcpy(&out.texels[first], added.values.data(), added.values.size() * sizeof(float));
    std::copy(added.shapes.begin(), added.shapes.end(), &out.texels[table]);
    std::fill_n(out.texels.end() - spare_words, spare_words, 0);
    out.textures[row].first = static_cast<int>(table);
    if (added.grey) out.textures[row].form |= TEXTURE_GREY;
    bounds[row] = bounds_of_values(added.values);
}

/// Of all textures, where some light has one.
void add_means(const Scene& scene, const Rows& rows, const Images& images, DeviceScene& out) {
    auto has_one = [](const Shape& shape) { return bool(shape.radiance_texture); };
    if (std::none_of(scene.shapes.begin(), scene.shapes.end(), has_one)) return;
    for (std::size_t row = 0; row < rows.textures().size(); row++) {
        int image = images.of_row[row];
        std::span<const std::byte> seen;
        if (image >= 0) seen = images.images[image].in(out.texels);
        out.texture_means.push_back(texture_mean(*rows.textures()[row], seen));
    }
}

void add_attributes(const Scene& scene, const Rows& rows, DeviceScene& out,
                    std::vector<ValueBounds>& bounds) {
    for (std::size_t row = 0; row < rows.textures().size(); row++)
        if (const auto* a = std::get_if<MeshAttributeTexture>(&rows.textures()[row]->kind))
            add_attribute(scene, *a, static_cast<int>(row), out, bounds);
}

/// Of the image around everything, the last; -1: none.
int sky_row(const Scene& scene, Rows& rows) {
    for (const Emitter& emitter : scene.emitters)
        if (const auto* sky = std::get_if<EnvmapEmitter>(&emitter)) return rows.apart(sky->image);
    return -1;
}

} // namespace

std::vector<std::shared_ptr<const Texture>> textures_of(const Scene& scene) {
    Rows rows;
    for (const Material& material : scene.materials) {
        MaterialTexturesRecord t = material_textures(material.bsdf, row_of(rows));
        set_tilt(t, material.tilt, {}, rows);
    }
    for (const Blend& blend : scene.blends)
        rows(blend.weight.texture);
    for (const Shape& shape : scene.shapes)
        rows(shape.radiance_texture);
    static_cast<void>(sky_row(scene, rows));
    return rows.textures();
}

void add_textures(const Scene& scene, DeviceScene& out) {
    out.material_textures.assign(scene.materials.size(), no_textures);
    out.blend_textures.assign(scene.blends.size(), -1);
    out.radiance_textures.assign(scene.shapes.size(), -1);
    if (!looks_at_materials(scene.integrator)) return;
    Rows rows;
    for (std::size_t i = 0; i < scene.materials.size(); i++) {
        out.material_textures[i] = material_textures(scene.materials[i].bsdf, row_of(rows));
        set_tilt(out.material_textures[i], scene.materials[i].tilt, out.frame, rows);
    }
    for (std::size_t i = 0; i < scene.blends.size(); i++)
        out.blend_textures[i] = rows(scene.blends[i].weight.texture);
    for (std::size_t i = 0; i < scene.shapes.size(); i++)
        out.radiance_textures[i] = rows(scene.shapes[i].radiance_texture);
    const int sky = looks_at_lights(scene.integrator) ? sky_row(scene, rows) : -1;
    const Images images = place_images(scene, rows);
    read_images(images.images, out.texels);
    std::vector<ValueBounds> bounds = bounds_of(rows, images, out.texels);
    bool bytes = false;
    for (std::size_t row = 0; row < rows.textures().size(); row++) {
        int image = images.of_row[row];
        out.textures.push_back(
            texture_record(*rows.textures()[row], image < 0 ? nullptr : &images.images[image]));
        bytes |= image >= 0 && TEXTURE_COMPONENT(out.textures.back().form) == 0;
    }
    add_attributes(scene, rows, out, bounds);
    check_values(rows, bounds);
    add_means(scene, rows, images, out);
    if (bytes) out.byte_values = make_byte_values();
    if (sky >= 0) out.environment = make_environment(out, sky);
}

std::span<const TextureRecord> surface_textures(const DeviceScene& records) {
    std::size_t of_sky = records.environment.texture >= 0 ? 1 : 0;
    return std::span(records.textures).first(records.textures.size() - of_sky);
}

std::size_t count_anisotropic(const DeviceScene& records) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < records.materials.size(); i++)
        count += is_anisotropic(records.materials[i], records.material_textures[i]) ? 1 : 0;
    return count;
}

bool reads_uvs(const Scene& scene, const DeviceScene& records) {
    const auto& aovs = scene.integrator.aovs;
    std::span<const TextureRecord> textures = surface_textures(records);
    return std::any_of(textures.begin(), textures.end(),
                       [](const TextureRecord& t) {
                           return TEXTURE_KIND(t.form) != texture_mesh_attribute;
                       }) ||
           std::any_of(aovs.begin(), aovs.end(),
                       [](const AovRequest& a) { return a.kind == "uv"; });
}

} // namespace parhelion
