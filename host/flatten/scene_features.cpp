// The one place that decides which features a scene's kernels have.
#include "host/flatten/scene_features.h"

#include "host/flatten/aov_plan.h"
#include "host/flatten/daylight.h"
#include "host/flatten/energy_table.h"
#include "host/flatten/feature_counts.h"
#include "host/flatten/filter_table.h"
#include "host/flatten/kind_names.h"
#include "host/flatten/lobe_lists.h"
#include "host/flatten/material_records.h"
#include "host/flatten/principled_features.h"
#include "host/flatten/texture_features.h"
#include "host/flatten/texture_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>

namespace parhelion {
namespace {

// By kind.
constexpr std::array material_features{MATERIALS(FEATURE_MATERIAL)};
constexpr std::array emitter_features{EMITTERS(FEATURE_EMITTER)};
constexpr std::array geometry_features{GEOMETRIES(FEATURE_GEOMETRY)};

// Measured: packets win while the tree (50 bytes a primitive) stays near the caches' size.
constexpr std::size_t primitives_for_packets = 500'000;

constexpr int no_limit = std::numeric_limits<int>::max(); // of a path's edges

bool is_beckmann(const MaterialRecord& m) { return is_rough(m) && (m.distribution & 1); }
bool is_ggx(const MaterialRecord& m) { return is_rough(m) && !(m.distribution & 1); }
bool is_matte(const MaterialRecord& m) { return (MATTE_MATERIALS >> m.kind) & 1; }
bool lets_through(const MaterialRecord& m) { return (PASSING_MATERIALS >> m.kind) & 1; }
bool is_nothing(const MaterialRecord& m) { return m.kind == material_null; }

void decide_materials(const DeviceScene& records, FeatureDecisions& out) {
    const auto& materials = records.materials;
    decide_kinds(out, material_features, materials, "materials",
                 [](const MaterialRecord& m) { return m.kind; });
    decide_by_count(out, feature_ggx, materials, "materials", is_ggx);
    decide_by_count(out, feature_beckmann, materials, "materials", is_beckmann);
    out.decide(feature_anisotropy, has_anisotropic(records),
               fmt::format("{} of {} materials", count_anisotropic(records), materials.size()));
}

/// After anisotropy and textures.
void decide_tangents(const DeviceScene& records, FeatureDecisions& out) {
    Count tilted = count_of(records.material_textures, "materials have tilted normals",
                            [](const MaterialTexturesRecord& t) { return t.tilt >= 0; });
    out.decide(feature_tangents, out.has(feature_anisotropy) || tilted.any,
               fmt::format("{}, {} anisotropic", tilted.text, count_anisotropic(records)));
}

void decide_analytic_uvs(const Scene& scene, const DeviceScene& records,
                         const std::vector<ShapeRecord>& shapes, FeatureDecisions& out) {
    Count analytic = count_of(shapes, "shapes have no vertices", [](const ShapeRecord& s) {
        return (s.flags & PRIMITIVE_KIND_MASK) != geometry_triangle;
    });
    bool read = reads_uvs(scene, records);
    out.decide(feature_analytic_uvs, analytic.any && read,
               fmt::format("{}, {} reads them", analytic.text, read ? "something" : "nothing"));
}

bool is_black(const MaterialRecord& m) {
    return m.kind == material_diffuse && m.r == 0.f && m.g == 0.f && m.b == 0.f;
}

/// Whether light from below finds what a front alone does to it by itself: what is opaque absorbs.
bool follows_from(const DeviceScene& records, int front, int back) {
    // Share of each, by the textures that tell it, at the front, less that at the back.
    std::map<std::array<int, 1 + LOBE_FACTORS>, float> transparent;
    auto kind = [](const LobeRecord& l) {
        return std::array{l.material, l.factor0, l.factor1, l.factor2, l.factor3};
    };
    bool follows = true;
    for (const LobeRecord& lobe : lobes_of(records, front))
        if (!is_opaque(records.materials[lobe.material])) transparent[kind(lobe)] += lobe.weight;
    for (const LobeRecord& lobe : lobes_of(records, back)) {
        const MaterialRecord& m = records.materials[lobe.material];
        if (is_opaque(m))
            follows &= is_black(m);
        else
            transparent[kind(lobe)] -= lobe.weight;
    }
    auto same = [](const auto& share) { return share.second == 0.f; };
    return follows && std::all_of(transparent.begin(), transparent.end(), same);
}

/// Shapes that have primitives.
std::vector<ShapeRecord> shapes_there(const Scene& scene, const DeviceScene& records) {
    std::vector<ShapeRecord> there;
    for (std::size_t i = 0; i < scene.shapes.size(); i++)
        if (primitive_count(scene.shapes[i]) > 0) there.push_back(records.geometry.shapes[i]);
    return there;
}

void decide_surfaces(const Scene& scene, const DeviceScene& records, FeatureDecisions& out) {
    std::vector<ShapeRecord> shapes = shapes_there(scene, records);
    decide_kinds(out, geometry_features, shapes, "shapes",
                 [](const ShapeRecord& s) { return s.flags & PRIMITIVE_KIND_MASK; });
    auto has = [](int flag) { return [flag](const ShapeRecord& s) { return s.flags & flag; }; };
    decide_by_count(out, feature_vertex_normals, shapes, "shapes", has(PRIMITIVE_NORMALS));
    decide_by_count(out, feature_vertex_uvs, shapes, "shapes, where they are read",
                    has(PRIMITIVE_UVS));
    decide_by_count(out, feature_back_materials, shapes, "shapes", [&](const ShapeRecord& s) {
        return !follows_from(records, s.material_front, s.material_back);
    });
    decide_by_count(out, feature_blends, shapes, "shapes", [](const ShapeRecord& s) {
        return IS_BLEND(s.material_front) || IS_BLEND(s.material_back);
    });
    decide_analytic_uvs(scene, records, shapes, out);
    std::size_t primitives = records.geometry.primitives.size();
    out.decide(feature_ray_streams, traced_in_streams(primitives),
               fmt::format("{} primitives; packets up to {}", primitives, primitives_for_packets));
}

/// Rows of lights that have a texture, and are surfaces or have no size.
std::size_t textured_lights(const DeviceScene& records, bool surfaces) {
    std::size_t count = 0;
    const std::vector<int>& words = records.light_textures;
    for (std::size_t i = 0; i < records.lights.size() && !words.empty(); i++) {
        const int* row = &words[LIGHT_TEXTURE_WORDS * i];
        count += row[0] >= 0 && (row[2] > 0) == surfaces ? 1 : 0;
    }
    return count;
}

void decide_lights(const DeviceScene& records, FeatureDecisions& out) {
    decide_kinds(out, emitter_features, records.lights, "lights",
                 [](const LightRecord& light) { return light.kind; });
    std::size_t lights = records.lights.size(), textured = textured_lights(records, true);
    std::size_t projected = textured_lights(records, false);
    out.decide(feature_textured_lights, textured > 0,
               fmt::format("{} of {} shines by a texture", textured, counted(lights, "light")));
    out.decide(feature_projected_textures, projected > 0,
               fmt::format("{} of {} shines through one", projected, counted(lights, "light")));
    out.decide(feature_several_lights, lights > 1, counted(lights, "light"));
    decide_daylight(records, out);
}

/// What of light transport an integrator asks for, and the scene has.
struct Transport {
    bool asked, lit, emission, several, next_event, through, sees, scatters, roulette;
    std::string found;
    Count passing; ///< materials that let rays go straight on
    Count nothing; ///< of those, that are no surface at all
};

std::string edges(int longest) {
    return longest == no_limit ? "paths of any length"
                               : "paths of at most " + counted(longest, "edge");
}

Transport transport(const Integrator& integrator, const DeviceScene& records) {
    Transport t{};
    t.passing = count_of(records.materials, "materials let rays go straight on", lets_through);
    t.nothing = count_of(records.materials, "materials are no surface at all", is_nothing);
    t.asked = integrator.kind == IntegratorKind::path || integrator.kind == IntegratorKind::direct;
    if (!t.asked) {
        t.found = "no light transport is asked for";
        return t;
    }
    t.lit = !records.lights.empty();
    int longest = longest_path(integrator);
    auto met =
        std::count_if(records.lights.begin(), records.lights.end(), [](const LightRecord& light) {
            return emitter_places[light.kind] != place_nowhere;
        });
    bool seen = met > 0;
    t.emission = seen && longest != 0;
    t.several = longest >= 2;
    t.next_event = t.lit && t.several && integrator.emitter_samples;
    // As in Mitsuba 3: what lets rays straight through is a surface like others to `direct`.
    t.through = integrator.kind == IntegratorKind::path && t.passing.any;
    // After the last scattering only emission can be met: with point lights alone nothing is. But
    // what lies behind a surface that lets rays through covers the pixel, lit or not.
    t.sees = seen || (t.lit && longest >= 3) || t.through;
    t.scatters = t.several && integrator.bsdf_samples && t.sees;
    t.roulette = t.scatters && longest > integrator.rr_depth;
    t.found = fmt::format("{}, {} of which rays can meet, {}",
                          counted(records.lights.size(), "light"), met, edges(longest));
    return t;
}

/// After vertex normals.
void decide_shading_normals(const Integrator& integrator, const DeviceScene& records,
                            const Transport& t, FeatureDecisions& out) {
    bool smooth = out.has(feature_vertex_normals), shaded = t.next_event || t.scatters;
    Count matte = count_of(records.materials, "materials matte", is_matte);
    std::string found =
        fmt::format("{} smooth shapes{}, shading normals are {}", smooth ? "some" : "no",
                    shaded ? "" : fmt::format(", no surface is lit ({})", t.found),
                    shading_normals_names[static_cast<std::size_t>(integrator.shading_normals)]);
    bool wanted = smooth && shaded;
    out.decide(feature_consistent_normals,
               wanted && integrator.shading_normals != ShadingNormals::raw, found);
    out.decide(feature_soft_terminator,
               wanted && matte.any && integrator.shading_normals == ShadingNormals::soft,
               fmt::format("{}, {}", found, matte.text));
}

void decide_transport(const Scene& scene, const DeviceScene& records, FeatureDecisions& out) {
    const Integrator& integrator = scene.integrator;
    Transport t = transport(integrator, records);
    const char* sampled = integrator.emitter_samples ? "sampled" : "not sampled";
    out.decide(feature_emission, t.emission, t.found);
    out.decide(feature_next_event, t.next_event,
               fmt::format("{}, lights are {}", t.found, sampled));
    out.decide(feature_light_tree, t.next_event && !records.light_tree.nodes.empty(),
               fmt::format("{} of the tree, {}, lights are {}",
                           counted(records.light_tree.nodes.size(), "node"), t.found, sampled));
    bool looks_through = integrator.kind == IntegratorKind::path;
    const char* else_what =
        looks_through ? "" : ", which this integrator takes for surfaces like others";
    out.decide(feature_straight_through, t.through, t.passing.text + else_what);
    out.decide(feature_clear_shadows, t.through && t.next_event && t.nothing.any,
               fmt::format("{}{}, lights are {}", t.nothing.text, else_what, sampled));
    out.decide(feature_scattering, t.scatters, t.found);
    out.decide(feature_russian_roulette, t.roulette,
               fmt::format("{}, roulette from edge {} on", t.found, integrator.rr_depth));
    if (t.asked)
        decide_by_request(out, feature_hide_emitters, integrator.hide_emitters);
    else
        out.decide(feature_hide_emitters, false, t.found);
    decide_shading_normals(integrator, records, t, out);
}

void decide_camera_and_sampler(const Scene& scene, const DeviceScene& records,
                               FeatureDecisions& out) {
    const Sampler& sampler = scene.sampler;
    bool pattern = sampler.pattern == SamplePattern::faure;
    const char* name = sample_pattern_names[static_cast<std::size_t>(sampler.pattern)];
    out.decide(feature_faure, pattern, name);
    out.decide(feature_replicates, pattern && sampler.replicates > 1,
               fmt::format("{}, {}", name, counted(sampler.replicates, "replicate")));
    out.decide(feature_thin_lens, scene.camera.aperture_radius > 0.0,
               fmt::format("aperture of radius {}", scene.camera.aperture_radius));
    out.decide(feature_orthographic, scene.camera.orthographic,
               scene.camera.orthographic ? "parallel rays" : "a camera of perspective");
    out.decide(feature_far_camera, records.frame.start > 0.0,
               fmt::format("rays start at {}", records.frame.start));
}

void decide_film(const Scene& scene, FeatureDecisions& out) {
    const Integrator& integrator = scene.integrator;
    bool box = scene.film.filter.kind == FilterKind::box;
    int reach = box ? 0 : filter_reach(scene.film);
    std::string filter = box ? "box filter" : fmt::format("a filter that reaches {} pixels", reach);
    out.decide(feature_filter_splatting, reach > 0, filter);
    out.decide(feature_filter_sampling, !box && reach == 0, filter);
    decide_by_request(out, feature_view_normals, integrator.kind == IntegratorKind::normals);
    decide_by_request(out, feature_view_depth, integrator.kind == IntegratorKind::depth);
    decide_by_request(out, feature_moments, integrator.second_moment);
    decide_by_count(out, feature_variance, integrator.aovs, "layers", is_film_aov);
    decide_by_request(out, feature_shape_ids, integrator.cryptomatte.asked());
    decide_by_request(out, feature_light_groups, !integrator.light_groups.empty());
    decide_by_count(out, feature_aovs, integrator.aovs, "layers", is_first_hit_aov);
}

} // namespace

int longest_path(const Integrator& integrator) {
    switch (integrator.kind) {
    case IntegratorKind::path:
        return integrator.max_depth < 0 ? no_limit : integrator.max_depth;
    case IntegratorKind::direct:
        return 2;
    case IntegratorKind::depth:
    case IntegratorKind::normals:
    case IntegratorKind::aov:
        return 1;
    }
    return 1;
}

FeatureDecisions scene_features(const Scene& scene, const DeviceScene& records) {
    FeatureDecisions out;
    decide_materials(records, out);
    decide_principled_features(records, out);
    decide_texture_features(records, out);
    decide_tangents(records, out);
    decide_surfaces(scene, records, out);
    decide_lights(records, out);
    decide_camera_and_sampler(scene, records, out);
    decide_film(scene, out);
    decide_transport(scene, records, out);
    return out;
}

void decide_energy_compensation(const Scene& scene, DeviceScene& records) {
    std::size_t values = records.energy_tables.size();
    Count asking =
        count_of(scene.materials, "materials make up for what they scatter more than once",
                 [](const Material& m) { return wants_energy_compensation(m.bsdf); });
    records.features.decide(
        feature_energy_compensation, asking.any && values > 0,
        fmt::format("{}, {} of energy tables", asking.text, counted(values, "value")));
}

bool traced_in_streams(std::size_t primitives) { return primitives > primitives_for_packets; }

FeatureSet neutral_features() {
    // Not anisotropy (turns the frame), back materials (a blend has lobes there), what decides
    // which light counts, views, film layouts; normals, uvs, a sky's row are there where needed.
    FeatureSet neutral{feature_ggx, feature_beckmann, feature_ray_streams};
    for (Feature f : {MATERIALS(FEATURE_MATERIAL) GEOMETRIES(FEATURE_GEOMETRY)})
        neutral.set(f);
    for (Feature f : {EMITTERS_BY_ROW(FEATURE_EMITTER)})
        neutral.set(f, f != feature_emitter_constant);
    return neutral;
}

} // namespace parhelion
