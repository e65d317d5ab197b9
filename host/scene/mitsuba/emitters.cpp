// The emitter plugins.
#include "host/scene/mitsuba/leniency.h"
#include "host/scene/mitsuba/number_parameters.h"
#include "host/scene/mitsuba/plugin_table.h"
#include "host/scene/mitsuba/plugins.h"
#include "host/scene/mitsuba/properties.h"
#include "host/scene/mitsuba/textures.h"
#include "host/scene/mitsuba/transforms.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace parhelion::mitsuba {

glm::dvec3 unit_direction(Properties& p, const char* name, const glm::dvec3& direction) {
    const glm::dvec3 unit = unit_vector(direction);
    if (!(glm::length(unit) > 0.5)) p.refuse_value(name, "without a direction", "not zero");
    return unit;
}

void check_similarity(Properties& p, const glm::dmat4& to_world, const char* what) {
    constexpr double tolerance = 1e-4;
    const glm::dmat3 m(to_world);
    const double scale = glm::length(m[2]);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            if (!(std::abs(glm::dot(m[i], m[j]) / (scale * scale) - (i == j ? 1.0 : 0.0)) <
                  tolerance))
                p.refuse_value("to_world", std::string("a transform that deforms ") + what,
                               "rotation, translation, uniform scale");
}

glm::dmat3 turned_axes(Properties& p, const glm::dmat4& to_world) {
    glm::dmat3 axes(1.0);
    for (int axis = 0; axis < 3; axis++)
        axes[axis] = unit_direction(p, "to_world", glm::dvec3(to_world[axis]));
    return axes;
}

namespace {

Rgb read_emission(Properties& p, const char* name) {
    return p.color(name, Rgb(1.0), SpectrumUse::emission);
}

void refuse_together(Properties& p, const char* name) {
    if (p.has(name) && p.has("to_world"))
        p.refuse_value(name, "given together with \"to_world\"", "one or the other");
}

Emitter read_point(Properties& p) {
    refuse_together(p, "position");
    const glm::dvec3 moved(p.transform("to_world")[3]);
    return PointEmitter{p.vector("position", moved), read_emission(p, "intensity")};
}

/// What a mesh has is nothing that light could pass through on its way there.
void refuse_attribute(Properties& p, const char* name, const TextureUse& use) {
    if (use && std::holds_alternative<MeshAttributeTexture>(use.texture->kind))
        p.refuse_value(name, "a mesh_attribute", "bitmap, checkerboard, or the same everywhere");
}

/// Less than half of all directions can be seen as a picture.
constexpr double widest_slide = 90.0;

/// A texture fills the square about the cone. One that is the same everywhere is no texture.
void read_slide(Properties& p, const glm::dmat4& to_world, double cutoff, SpotEmitter& spot) {
    const Textured<Rgb> texture = p.textured_color("texture", Rgb(1.0), SpectrumUse::emission);
    refuse_attribute(p, "texture", texture.texture);
    if (!texture.texture) {
        spot.intensity *= texture.constant;
        return;
    }
    if (!(cutoff < widest_slide))
        p.refuse_value("cutoff_angle", fmt::format("{} with a texture", cutoff),
                       "less than 90 degrees");
    const glm::dmat3 axes = turned_axes(p, to_world);
    const double scale = 0.5 / std::tan(spot.cutoff_angle);
    spot.slide = {scale * axes[0], scale * axes[1], texture.texture};
}

Emitter read_spot(Properties& p) {
    const glm::dmat4 to_world = p.transform("to_world");
    check_similarity(p, to_world, "the cone of light");
    const double cutoff = p.number("cutoff_angle", 20.0);
    const double beam = p.number("beam_width", cutoff * 3.0 / 4.0);
    if (beam > cutoff) p.refuse_value("beam_width", std::to_string(beam), "up to cutoff_angle");
    SpotEmitter spot{glm::dvec3(to_world[3]),
                     unit_direction(p, "to_world", glm::dvec3(to_world[2])), glm::radians(cutoff),
                     glm::radians(beam), read_emission(p, "intensity")};
    read_slide(p, to_world, cutoff, spot);
    return spot;
}

/// Columns and rows that the picture has; what has none is square.
glm::ivec2 size_of(const TextureUse& use) {
    const auto* const bitmap = use ? std::get_if<BitmapTexture>(&use.texture->kind) : nullptr;
    return bitmap ? glm::ivec2(bitmap->source.layout.width, bitmap->source.layout.height)
                  : glm::ivec2(1);
}

/// Its picture is what a camera there would see: to its left lies +x.
Emitter read_projector(Properties& p) {
    const glm::dmat4 to_world = p.transform("to_world");
    check_similarity(p, to_world, "the picture");
    const glm::dmat3 axes = turned_axes(p, to_world);
    const Textured<Rgb> irradiance =
        p.textured_color("irradiance", Rgb(1.0), SpectrumUse::emission);
    refuse_attribute(p, "irradiance", irradiance.texture);
    Camera lens;
    read_field_of_view(p, lens);
    const glm::ivec2 size = size_of(irradiance.texture);
    const double width = 2.0 * std::tan(0.5 * horizontal_fov(lens, size.x, size.y));
    ProjectorEmitter e;
    e.position = glm::dvec3(to_world[3]);
    e.direction = axes[2];
    e.slide = {-axes[0] / width, -axes[1] / (width * size.y / size.x), irradiance.texture};
    e.irradiance = irradiance.texture ? Rgb(1.0) : irradiance.constant;
    e.irradiance *= p.number("scale", 1.0);
    return e;
}

Emitter read_directional(Properties& p) {
    refuse_together(p, "direction");
    const glm::dvec3 turned(p.transform("to_world")[2]);
    const char* const name = p.has("direction") ? "direction" : "to_world";
    return DirectionalEmitter{unit_direction(p, name, p.vector("direction", turned)),
                              read_emission(p, "irradiance")};
}

Emitter read_constant(Properties& p) {
    p.transform("to_world"); // it looks the same from every side
    return ConstantEmitter{read_emission(p, "radiance")};
}

/// Mitsuba's least for a sky.
constexpr int least_rows = 3;

/// With its last row as often as is missing: what Mitsuba makes of so few.
TexelSource with_least_rows(TexelSource image) {
    const TexelLayout layout = image.layout;
    if (layout.height >= least_rows) return image;
    image.layout.height = least_rows;
    image.name += " (its last row repeated)";
    image.read = [layout, read = std::move(image.read)](std::span<std::byte> to) {
        read(to.first(layout.bytes()));
        const std::size_t row = layout.bytes() / static_cast<std::size_t>(layout.height);
        for (std::size_t end = layout.bytes(); end < to.size(); end += row)
            std::copy_n(&to[end - row], row, &to[end]);
    };
    return image;
}

Emitter read_envmap(Properties& p) {
    EnvmapEmitter e;
    BitmapTexture bitmap;
    bitmap.source = with_least_rows(read_image(p, "filename"));
    const SourceLocation place = p.location_of("filename");
    e.image = {std::make_shared<const Texture>(Texture{p.object().id, glm::dmat3(1.0), bitmap}),
               place, p.title() + ": its image",
               number_parameter("emitter", "envmap", "scale").domain};
    const glm::dmat4 to_world = p.transform("to_world");
    check_similarity(p, to_world, "the sky");
    e.to_world = turned_axes(p, to_world);
    e.radiance = Rgb(p.number("scale", 1.0));
    if (p.boolean("mis_compensation", false))
        p.note("mis_compensation", "\"mis_compensation\" is not used; only the noise differs");
    return e;
}

using EmitterReader = Emitter (*)(Properties&);

constexpr PluginTable<EmitterReader, 10> emitter_plugins = {{{"point", read_point},
                                                             {"spot", read_spot},
                                                             {"directional", read_directional},
                                                             {"constant", read_constant},
                                                             {"envmap", read_envmap},
                                                             {"projector", read_projector},
                                                             {"sunsky", read_sunsky},
                                                             {"sun", read_sun},
                                                             {"sky", read_sky},
                                                             {"area", nullptr}}};

/// How often Mitsuba picks this emitter; zero would mean that it picks none of its light.
void read_sampling_weight(Properties& p) {
    if (p.number("sampling_weight", 1.0) != 1.0)
        p.note("sampling_weight", "\"sampling_weight\" is not used, emitters are picked by what "
                                  "they send; only the noise differs");
}

} // namespace

Emitter read_emitter(const Document& document, const Object& object, Notes& notes) {
    const auto kin = kin_outside(emitter_plugins, document, object, notes);
    const Object& known = kin ? *kin : object;
    Properties p(document, known, notes);
    const EmitterReader read = find_plugin(emitter_plugins, known);
    if (!read) refuse(object.location, p.title() + " can only stand inside a <shape>");
    const Emitter emitter = read(p);
    read_sampling_weight(p);
    p.finish();
    return emitter;
}

Textured<Rgb> read_area_emitter(const Document& document, const Object& object, Notes& notes) {
    Properties p(document, object, notes);
    if (find_plugin(emitter_plugins, object))
        refuse(object.location, p.title() + " cannot stand inside a <shape> (accepted: area)");
    const Textured<Rgb> radiance = p.textured_color("radiance", Rgb(1.0), SpectrumUse::emission);
    read_sampling_weight(p);
    p.finish();
    return radiance;
}

} // namespace parhelion::mitsuba
