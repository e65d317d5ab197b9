// The one place that decides which features a scene's kernels have.
#include "host/render/scene_features.h"

#include "host/error.h"
#include "host/render/device_scene.h"
#include "host/render/energy_table.h"
#include "host/render/film_image.h"
#include "host/render/filter_table.h"
#include "host/render/material_records.h"
#include "host/render/parallelograms.h"

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

struct FeatureSet {
    std::uint64_t mask = 0;
    void add(Feature f) { mask |= feature_bit(f); }
    void add_if(bool wanted, Feature f) {
        if (wanted) add(f);
    }
};

void add_roughness(MicrofacetDistribution d, double alpha_u, double alpha_v, FeatureSet& set) {
    // GGX is always there: Beckmann is sampled by its visible normals.
    set.add(feature_ggx);
    set.add_if(d == MicrofacetDistribution::beckmann, feature_beckmann);
    set.add_if(alpha_u != alpha_v, feature_anisotropy);
}

void add_bsdf(const DiffuseBsdf&, FeatureSet& set) { set.add(feature_bsdf_diffuse); }
void add_bsdf(const ConductorBsdf&, FeatureSet& set) { set.add(feature_bsdf_conductor); }
void add_bsdf(const DielectricBsdf&, FeatureSet& set) { set.add(feature_bsdf_dielectric); }
void add_bsdf(const ThinDielectricBsdf&, FeatureSet& set) { set.add(feature_bsdf_thindielectric); }
void add_bsdf(const NullBsdf&, FeatureSet& set) { set.add(feature_bsdf_null); }
void add_bsdf(const RoughConductorBsdf& b, FeatureSet& set) {
    set.add(feature_bsdf_roughconductor);
    add_roughness(b.distribution, b.alpha_u, b.alpha_v, set);
}
void add_bsdf(const RoughDielectricBsdf& b, FeatureSet& set) {
    set.add(feature_bsdf_roughdielectric);
    add_roughness(b.distribution, b.alpha_u, b.alpha_v, set);
}

bool is_opaque(const Bsdf& bsdf) { return (OPAQUE_MATERIALS >> material_record(bsdf).kind) & 1; }

void add_materials(const Scene& scene, FeatureSet& set) {
    for (const Material& m : scene.materials)
        std::visit([&](const auto& b) { add_bsdf(b, set); }, m.bsdf);
    for (const Shape& shape : scene.shapes) {
        bool differs = shape.material_front != shape.material_back;
        bool turned =
            shape.material_back >= 0 && is_opaque(scene.materials[shape.material_back].bsdf);
        // A front of null and a black back differ too, but a one-sided opaque front absorbs below
        // by itself.
        bool black_back = shape.material_back < 0 && shape.material_front >= 0 &&
                          is_opaque(scene.materials[shape.material_front].bsdf);
        set.add_if((differs && !black_back) || turned, feature_back_materials);
    }
}

bool reads_uv(const Scene& scene, const FeatureSet& set) {
    auto is_uv = [](const AovRequest& a) { return a.kind == "uv"; };
    return (set.mask & feature_bit(feature_anisotropy)) ||
           std::any_of(scene.integrator.aovs.begin(), scene.integrator.aovs.end(), is_uv);
}

void add_mesh_emitter(const Mesh& mesh, const SceneFrame& frame, FeatureSet& set) {
    std::vector<bool> starts = starts_parallelogram(mesh, frame);
    auto pairs = std::count(starts.begin(), starts.end(), true);
    set.add_if(pairs > 0, feature_emitter_area_parallelogram);
    set.add_if(2 * pairs < std::ssize(starts), feature_emitter_area_triangle);
}

void add_shapes(const Scene& scene, const SceneFrame& frame, bool uv, FeatureSet& set) {
    for (const Shape& shape : scene.shapes) {
        if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
            set.add(feature_shape_triangle);
            set.add_if(!mesh->normals.empty(), feature_vertex_normals);
            set.add_if(!mesh->uvs.empty() && uv, feature_vertex_uvs);
            if (shape.radiance) add_mesh_emitter(*mesh, frame, set);
        } else if (std::holds_alternative<Sphere>(shape.geometry)) {
            set.add(feature_shape_sphere);
            set.add_if(shape.radiance.has_value(), feature_emitter_area_sphere);
        } else {
            set.add(feature_shape_disk);
            set.add_if(shape.radiance.has_value(), feature_emitter_area_disk);
        }
    }
}

std::size_t primitive_count(const Shape& shape) {
    const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
    return mesh ? mesh->triangles.size() : 1;
}

void add_traversal(const Scene& scene, FeatureSet& set) {
    std::size_t primitives = 0;
    for (const Shape& shape : scene.shapes)
        primitives += primitive_count(shape);
    set.mask |= traversal_features(primitives);
}

void add_emitter(const PointEmitter&, FeatureSet& set) { set.add(feature_emitter_point); }
void add_emitter(const SpotEmitter&, FeatureSet& set) { set.add(feature_emitter_spot); }
void add_emitter(const DirectionalEmitter&, FeatureSet& set) {
    set.add(feature_emitter_directional);
}
void add_emitter(const ConstantEmitter&, FeatureSet& set) { set.add(feature_emitter_constant); }

constexpr std::uint64_t meetable_emitters =
    feature_bit(feature_emitter_area_triangle) | feature_bit(feature_emitter_area_parallelogram) |
    feature_bit(feature_emitter_area_sphere) | feature_bit(feature_emitter_area_disk) |
    feature_bit(feature_emitter_constant);

#define EMITTER_BIT(name) | feature_bit(feature_emitter_##name)
constexpr std::uint64_t all_emitters = 0 EMITTERS(EMITTER_BIT);

void add_transport(const Integrator& integrator, FeatureSet& set) {
    bool lit = (set.mask & all_emitters) != 0;
    bool meetable = (set.mask & meetable_emitters) != 0;
    int longest = integrator.kind == IntegratorKind::direct ? 2 : integrator.max_depth;
    bool bounces = lit && (longest < 0 || longest >= 2);
    bool next_event = bounces && integrator.emitter_samples;
    set.add_if(meetable && longest != 0, feature_emission);
    set.add_if(next_event, feature_next_event);
    // After the last scattering only emission can be met: with point lights alone nothing is.
    bool scatters = bounces && integrator.bsdf_samples && (meetable || longest < 0 || longest >= 3);
    set.add_if(scatters, feature_scattering);
    set.add_if(scatters && (longest < 0 || longest > integrator.rr_depth),
               feature_russian_roulette);
    set.add_if(integrator.hide_emitters, feature_hide_emitters);
}

/// After what scatters at all is known.
void add_surface_features(const Scene& scene, FeatureSet& set) {
    auto wants = [](const Material& m) { return wants_energy_compensation(m.bsdf); };
    bool lit = set.mask & (feature_bit(feature_next_event) | feature_bit(feature_scattering));
    bool smooth = set.mask & feature_bit(feature_vertex_normals);
    set.add_if(lit && smooth && scene.integrator.shading_normals == ShadingNormals::consistent,
               feature_consistent_normals);
    set.add_if(lit && std::any_of(scene.materials.begin(), scene.materials.end(), wants),
               feature_energy_compensation);
}

void add_filter(const Film& film, FeatureSet& set) {
    if (film.filter.kind == FilterKind::box) return;
    set.add(filter_reach(film) > 0 ? feature_filter_splatting : feature_filter_sampling);
}

} // namespace

std::uint64_t scene_features(const Scene& scene, const SceneFrame& frame) {
    FeatureSet set;
    const Integrator& integrator = scene.integrator;
    add_materials(scene, set);
    add_shapes(scene, frame, reads_uv(scene, set), set);
    add_traversal(scene, set);
    for (const Emitter& e : scene.emitters)
        std::visit([&](const auto& x) { add_emitter(x, set); }, e);
    set.add_if(scene.sampler.pattern == SamplePattern::sobol, feature_sobol);
    set.add_if(scene.camera.aperture_radius > 0.0, feature_thin_lens);
    add_filter(scene.film, set);
    set.add_if(integrator.kind == IntegratorKind::normals, feature_view_normals);
    set.add_if(integrator.kind == IntegratorKind::depth, feature_view_depth);
    set.add_if(integrator.second_moment, feature_moments);
    for (const AovRequest& aov : integrator.aovs)
        set.add(is_film_aov(aov) ? feature_variance : feature_aovs);
    if (integrator.kind == IntegratorKind::path || integrator.kind == IntegratorKind::direct)
        add_transport(integrator, set);
    add_surface_features(scene, set);
    return set.mask;
}

std::uint64_t traversal_features(std::size_t primitives) {
    // Measured: packets win while the tree (50 bytes a primitive) stays near the caches' size.
    constexpr std::size_t in_cache = 500'000;
    return primitives > in_cache ? feature_bit(feature_ray_streams) : 0;
}

std::uint64_t light_tree_features(std::uint64_t scene_features) {
    bool chooses = scene_features & feature_bit(feature_next_event);
    return chooses ? feature_bit(feature_light_tree) : 0;
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
