// The sensor plugins and the sampler.
#include "host/scene/mitsuba/leniency.h"
#include "host/scene/mitsuba/plugin_table.h"
#include "host/scene/mitsuba/plugins.h"
#include "host/scene/mitsuba/properties.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace parhelion::mitsuba {

namespace {

glm::dmat4 read_camera_to_world(Properties& p) {
    constexpr double tolerance = 1e-3; // as in Mitsuba
    const glm::dmat4 to_world = p.transform("to_world");
    const glm::dmat3 m(to_world);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            if (!(std::abs(glm::dot(m[i], m[j]) - (i == j ? 1.0 : 0.0)) < tolerance))
                p.refuse_value("to_world", "a transform with scale or shear",
                               "rotation, translation, mirror");
    return to_world;
}

/// "50" or "50mm".
double read_focal_length(Properties& p) {
    std::string text = p.text("focal_length", "50mm");
    const std::string written = text;
    if (text.ends_with("mm")) text.resize(text.size() - 2);
    const std::optional<double> length = parse_number(text);
    if (!length) p.refuse_value("focal_length", in_quotes(written), "millimetres such as \"50mm\"");
    return p.checked("focal_length", *length);
}

} // namespace

void read_field_of_view(Properties& p, Camera& camera) {
    p.knows({"focal_length", "fov_axis"});
    if (!p.has("fov")) {
        camera.focal_length_mm = read_focal_length(p);
        return;
    }
    if (p.has("focal_length"))
        p.refuse_value("focal_length", "given together with \"fov\"", "one or the other");
    camera.fov_degrees = p.number("fov", 0.0);
    constexpr FovAxis axes[] = {FovAxis::x, FovAxis::y, FovAxis::diagonal, FovAxis::smaller,
                                FovAxis::larger};
    camera.fov_axis = axes[p.choice("fov_axis", "x", {"x", "y", "diagonal", "smaller", "larger"})];
}

namespace {

/// Near and far plane, and what does not change the picture.
void read_depths(Properties& p, Camera& camera) {
    camera.near_clip = p.number("near_clip", 1e-2);
    camera.far_clip = p.number("far_clip", 1e4);
    if (!(camera.near_clip < camera.far_clip))
        p.refuse_value("near_clip", "not below \"far_clip\"", "less than far_clip");
    // Mitsuba keeps it for both cameras; a pinhole has no use for it.
    camera.focus_distance = p.number("focus_distance", camera.far_clip);
    // Nothing moves, so the shutter does not change the picture.
    const double open = p.number("shutter_open", 0.0);
    if (p.number("shutter_close", 0.0) < open)
        p.refuse_value("shutter_close", "before \"shutter_open\"", "not before it");
}

Camera read_projective(Properties& p) {
    Camera camera;
    camera.to_world = read_camera_to_world(p);
    read_field_of_view(p, camera);
    read_depths(p, camera);
    return camera;
}

Camera read_perspective(Properties& p) {
    Camera camera = read_projective(p);
    camera.principal_point_offset = {p.number("principal_point_offset_x", 0.0),
                                     p.number("principal_point_offset_y", 0.0)};
    return camera;
}

Camera read_thin_lens(Properties& p) {
    Camera camera = read_projective(p);
    camera.aperture_radius = p.required_number("aperture_radius");
    if (!(camera.focus_distance >= 1e-20))
        p.refuse_value("focus_distance", fmt::format("{}", camera.focus_distance),
                       "1e-20 or greater");
    return camera;
}

/// As in Mitsuba, a scale along z moves the near plane, and the far plane stays as far behind it.
Camera read_orthographic(Properties& p) {
    Camera camera;
    camera.orthographic = true;
    camera.to_world = p.transform("to_world");
    read_depths(p, camera);
    p.check();
    const double determinant = glm::determinant(glm::dmat3(camera.to_world));
    const double depth = glm::length(glm::dvec3(camera.to_world[2]));
    if (!(std::abs(determinant) > 0.0) || !std::isfinite(determinant) || !std::isfinite(depth))
        p.refuse_value("to_world", "a transform without inverse", "one that keeps volumes above 0");
    camera.to_world[2] /= depth;
    const double between = camera.far_clip - camera.near_clip;
    camera.near_clip *= depth;
    camera.far_clip = camera.near_clip + between;
    return camera;
}

using SensorReader = Camera (*)(Properties&);

constexpr PluginTable<SensorReader, 3> sensor_plugins = {{{"perspective", read_perspective},
                                                          {"thinlens", read_thin_lens},
                                                          {"orthographic", read_orthographic}}};

/// What the samplers of Mitsuba have besides sample_count and seed.
void read_nothing(Properties&) {}

void read_jitter(Properties& p) {
    if (!p.boolean("jitter", true)) p.note("jitter", "\"jitter\" is taken as true");
}

void read_orthogonal(Properties& p) {
    read_jitter(p);
    p.integer("strength", 2);
}

/// Of Mitsuba 0.x.
void read_scramble(Properties& p) { p.integer("scramble", 0); }

using SamplerReader = void (*)(Properties&);

constexpr PluginTable<SamplerReader, 8> sampler_plugins = {{{"independent", read_nothing},
                                                            {"stratified", read_jitter},
                                                            {"multijitter", read_jitter},
                                                            {"orthogonal", read_orthogonal},
                                                            {"ldsampler", read_nothing},
                                                            {"sobol", read_scramble},
                                                            {"halton", read_scramble},
                                                            {"hammersley", read_scramble}}};

} // namespace

Sampler read_sampler(const Document& document, const Object& object, Notes& notes) {
    const auto kin = kin_outside(sampler_plugins, document, object, notes);
    const Object& known = kin ? *kin : object;
    Properties p(document, known, notes);
    const SamplerReader read = find_plugin(sampler_plugins, known);
    read(p);
    Sampler sampler;
    sampler.plugin = known.plugin;
    sampler.samples_per_pixel = static_cast<int>(p.integer("sample_count", default_samples));
    sampler.seed = static_cast<std::uint32_t>(p.integer("seed", 0));
    p.integer("dimension", 4); // of 0.x: up to where its points are well spread
    if (known.plugin != "independent")
        p.note("", "sampler " + in_quotes(known.plugin) +
                       " does not choose the pattern of the samples, --sampler does; only the "
                       "noise differs");
    p.finish();
    return sampler;
}

/// A direction is rounded by 2^-24: pixels less than eight times that apart run together.
void note_narrow_pixels(Properties& p, const Camera& camera, const Film& film) {
    if (camera.orthographic) return;
    const double field = camera.fov_degrees ? glm::radians(*camera.fov_degrees)
                                            : 2.0 * std::atan(18.0 / *camera.focal_length_mm);
    const double pixel = field / std::max(film.width, film.height);
    if (pixel < 8 * 0x1p-24)
        p.note(camera.fov_degrees ? "fov" : "focal_length",
               fmt::format("pixels are {:.1e} radians apart, which directions in single precision "
                           "do not tell apart",
                           pixel));
}

SensorParts read_sensor(const Document& document, const Object& object, Notes& notes) {
    const auto kin = kin_outside(sensor_plugins, document, object, notes);
    const Object& known = kin ? *kin : object;
    Properties p(document, known, notes);
    const SensorReader read = find_plugin(sensor_plugins, known);
    SensorParts parts;
    const Object* const film = p.only_child("film");
    const Object* const sampler = p.only_child("sampler");
    parts.film.pixel_format = PixelFormat::rgb;
    parts.sampler.samples_per_pixel = default_samples;
    Problems problems;
    problems.attempt([&] {
        parts.camera = read(p);
        p.finish();
    });
    problems.attempt([&] {
        if (film) parts.film = read_film(document, *film, notes);
    });
    problems.attempt([&] {
        if (sampler) parts.sampler = read_sampler(document, *sampler, notes);
    });
    problems.throw_if_any();
    note_narrow_pixels(p, parts.camera, parts.film);
    return parts;
}

} // namespace parhelion::mitsuba
