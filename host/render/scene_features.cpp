// The one place that decides which features a scene's kernels have.
#include "host/render/scene_features.h"

#include "host/error.h"
#include "host/render/device_scene.h"
#include "host/render/film_image.h"
#include "host/render/filter_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace parhelion {
namespace {

#define MATERIAL_NAME(name, sides) "bsdf_" #name,
#define EMITTER_NAME(name) "emitter_" #name,
#define GEOMETRY_NAME(name) "shape_" #name,
#define OTHER_NAME(name) #name,
/// In the order of enum Feature.
constexpr std::array names_of_features{MATERIALS(MATERIAL_NAME) EMITTERS(EMITTER_NAME)
                                           GEOMETRIES(GEOMETRY_NAME) OTHER_FEATURES(OTHER_NAME)};
static_assert(names_of_features.size() == feature_count);

// By kind.
constexpr std::array material_features{MATERIALS(FEATURE_MATERIAL)};
constexpr std::array emitter_features{EMITTERS(FEATURE_EMITTER)};
constexpr std::array geometry_features{GEOMETRIES(FEATURE_GEOMETRY)};

struct FeatureSet {
    std::uint64_t mask = 0;
    void add(Feature f) { mask |= feature_bit(f); }
    void add_if(bool wanted, Feature f) {
        if (wanted) add(f);
    }
};

void add_material(const MaterialRecord& m, FeatureSet& set) {
    set.add(material_features[m.kind]);
    if (m.kind != material_roughconductor && m.kind != material_roughdielectric) return;
    // GGX is always there: Beckmann is sampled by its visible normals.
    set.add(feature_ggx);
    set.add_if(m.distribution & 1, feature_beckmann);
    set.add_if(m.alpha_u != m.alpha_v, feature_anisotropy);
}

bool is_opaque(const DeviceScene& records, int material) {
    return material >= 0 && ((OPAQUE_MATERIALS >> records.materials[material].kind) & 1);
}

/// Of the first primitive of a shape, which are all alike but for where they are.
void add_primitive(const PrimitiveRecord& p, const DeviceScene& records, FeatureSet& set) {
    set.add(geometry_features[p.flags & PRIMITIVE_KIND_MASK]);
    bool attributes = !records.vertices.empty();
    set.add_if(attributes && (p.flags & PRIMITIVE_NORMALS), feature_vertex_normals);
    set.add_if(attributes && (p.flags & PRIMITIVE_UVS), feature_vertex_uvs);
    bool differs = p.material_front != p.material_back;
    // A front of null and a black back differ too, but a one-sided opaque front absorbs below by
    // itself.
    bool black_back = p.material_back < 0 && is_opaque(records, p.material_front);
    set.add_if((differs && !black_back) || is_opaque(records, p.material_back),
               feature_back_materials);
}

void add_surfaces(const Scene& scene, const DeviceScene& records, FeatureSet& set) {
    for (const MaterialRecord& m : records.materials)
        add_material(m, set);
    std::size_t first = 0;
    for (const Shape& shape : scene.shapes) {
        std::size_t count = primitive_count(shape);
        if (count > 0) add_primitive(records.primitives[first], records, set);
        first += count;
    }
    set.mask |= traversal_features(records.primitives.size());
}

constexpr std::uint64_t meetable_emitters =
    feature_bit(feature_emitter_area_triangle) | feature_bit(feature_emitter_area_parallelogram) |
    feature_bit(feature_emitter_area_tiny_triangle) | feature_bit(feature_emitter_area_sphere) |
    feature_bit(feature_emitter_area_disk) | feature_bit(feature_emitter_constant);

#define EMITTER_BIT(name) | feature_bit(feature_emitter_##name)
constexpr std::uint64_t all_emitters = 0 EMITTERS(EMITTER_BIT);

void add_lights(const DeviceScene& records, FeatureSet& set) {
    for (const LightRecord& light : records.lights)
        set.add(emitter_features[light.kind]);
    set.add_if(records.lights.size() > 1, feature_several_lights);
}

bool passes(const MaterialRecord& m) { return (PASSING_MATERIALS >> m.kind) & 1; }

/// After surfaces and lights.
void add_transport(const Integrator& integrator, const DeviceScene& records, FeatureSet& set) {
    bool lit = !records.lights.empty();
    bool meetable = (set.mask & meetable_emitters) != 0;
    int longest = integrator.kind == IntegratorKind::direct ? 2 : integrator.max_depth;
    bool several = longest < 0 || longest >= 2;
    bool next_event = lit && several && integrator.emitter_samples;
    set.add_if(meetable && longest != 0, feature_emission);
    set.add_if(next_event, feature_next_event);
    set.add_if(next_event && !records.light_tree.nodes.empty(), feature_light_tree);
    // As in Mitsuba 3: what lets rays straight through is a surface like others to `direct`.
    bool through = integrator.kind == IntegratorKind::path &&
                   std::any_of(records.materials.begin(), records.materials.end(), passes);
    set.add_if(through, feature_straight_through);
    // After the last scattering only emission can be met: with point lights alone nothing is. But
    // what lies behind a surface that lets rays through covers the pixel, lit or not.
    bool sees = meetable || (lit && (longest < 0 || longest >= 3)) || through;
    bool scatters = several && integrator.bsdf_samples && sees;
    set.add_if(scatters, feature_scattering);
    set.add_if(scatters && (longest < 0 || longest > integrator.rr_depth),
               feature_russian_roulette);
    set.add_if(integrator.hide_emitters, feature_hide_emitters);
    bool smooth = set.mask & feature_bit(feature_vertex_normals);
    bool shaded = smooth && (next_event || scatters);
    set.add_if(shaded && integrator.shading_normals != ShadingNormals::raw,
               feature_consistent_normals);
    set.add_if(shaded && integrator.shading_normals == ShadingNormals::soft,
               feature_soft_terminator);
}

void add_filter(const Film& film, FeatureSet& set) {
    if (film.filter.kind == FilterKind::box) return;
    set.add(filter_reach(film) > 0 ? feature_filter_splatting : feature_filter_sampling);
}

} // namespace

std::uint64_t scene_features(const Scene& scene, const DeviceScene& records) {
    FeatureSet set;
    const Integrator& integrator = scene.integrator;
    add_surfaces(scene, records, set);
    add_lights(records, set);
    set.add_if(scene.sampler.pattern == SamplePattern::sobol, feature_sobol);
    set.add_if(scene.camera.aperture_radius > 0.0, feature_thin_lens);
    set.add_if(records.frame.start > 0.0, feature_far_camera);
    add_filter(scene.film, set);
    set.add_if(integrator.kind == IntegratorKind::normals, feature_view_normals);
    set.add_if(integrator.kind == IntegratorKind::depth, feature_view_depth);
    set.add_if(integrator.second_moment, feature_moments);
    for (const AovRequest& aov : integrator.aovs)
        set.add(is_film_aov(aov) ? feature_variance : feature_aovs);
    if (integrator.kind == IntegratorKind::path || integrator.kind == IntegratorKind::direct)
        add_transport(integrator, records, set);
    return set.mask;
}

std::uint64_t traversal_features(std::size_t primitives) {
    // Measured: packets win while the tree (50 bytes a primitive) stays near the caches' size.
    constexpr std::size_t in_cache = 500'000;
    return primitives > in_cache ? feature_bit(feature_ray_streams) : 0;
}

std::uint64_t neutral_features() {
#define MATERIAL_BIT(name, sides) | feature_bit(feature_bsdf_##name)
#define SHAPE_BIT(name) | feature_bit(feature_shape_##name)
    // Not anisotropy (turns the frame), nor what decides which light is counted, nor views and film
    // layouts. Vertex records and the sky's light row exist only where they are needed.
    return 0 MATERIALS(MATERIAL_BIT) GEOMETRIES(SHAPE_BIT) |
           (all_emitters & ~feature_bit(feature_emitter_constant)) |
           feature_bit(feature_back_materials) | feature_bit(feature_ggx) |
           feature_bit(feature_beckmann) | feature_bit(feature_ray_streams);
}

std::vector<std::string> feature_names(std::uint64_t mask) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < names_of_features.size(); i++)
        if ((mask >> i) & 1u) names.emplace_back(names_of_features[i]);
    return names;
}

std::uint64_t feature_mask(const std::vector<std::string>& names) {
    std::uint64_t mask = 0;
    for (const std::string& name : names) {
        auto found = std::find(names_of_features.begin(), names_of_features.end(), name);
        if (found == names_of_features.end())
            throw InputError(fmt::format("'{}' is no feature of kernels; there are {}", name,
                                         fmt::join(names_of_features, " ")));
        mask |= std::uint64_t{1} << (found - names_of_features.begin());
    }
    return mask;
}

} // namespace parhelion
