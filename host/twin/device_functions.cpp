// Functions of the kernels that read tables, as C++ in single precision.
#include "host/twin/device_functions.h"

#include "host/flatten/scene_arrays.h"
#include "host/twin/work_item.h"

#include "host/twin/opencl_names.h"

namespace parhelion {
namespace {

struct Kernels : WorkItem {
#define PARHELION_REAL float
#include "kernels/generate.cl"
// And of shading:
#include "device/daylight.h"
#include "device/environment.h"
#include "device/light_table.h"
#undef PARHELION_REAL
};

Kernels kernels_with(Feature feature) { return Kernels{{FeatureSet{feature}}}; }

Kernels::vec3 vector(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

} // namespace

PickedLight pick_light(const LightTree& tree, const std::array<float, 3>& p,
                       const std::array<float, 3>& n, std::uint32_t x, std::uint32_t y) {
    Kernels k = kernels_with(feature_light_tree);
    Kernels::LightPick pick =
        k.pick_light(tree.nodes.data(), vector(p), vector(n), Kernels::Mask{true}, x, y);
    return {pick.row, pick.pmf, pick.pmf_hint};
}

float light_pmf(const LightTree& tree, const std::array<float, 3>& p, int row) {
    Kernels k = kernels_with(feature_light_tree);
    return k.light_pmf(tree.nodes.data(), tree.leaves.data(), vector(p), row, Kernels::Mask{true});
}

namespace {

/// The kernels' functions with the tables of a scene, and its sky's row.
struct SkyKernels : Kernels {
    explicit SkyKernels(const DeviceScene& scene)
        : Kernels{{scene.features.on()}}, texture(scene.environment.texture) {
        SceneArrays arrays = scene_arrays(scene);
#define TABLE_OF_SCENE(type, name) tables.name = arrays.name.data();
        SCENE_BUFFERS(TABLE_OF_SCENE)
#undef TABLE_OF_SCENE
        light = load_Light(tables.lights, scene.sky_light);
    }
    SceneTables tables{};
    Light light{};
    int texture;
};

std::array<float, 3> components(const Kernels::vec3& v) { return {v.x, v.y, v.z}; }

} // namespace

SkyRadiance sky_seen(const DeviceScene& scene, const std::array<float, 3>& w) {
    SkyKernels k(scene);
    auto towards = [&](auto of) { return (k.*of)(k.tables, k.light, k.texture, vector(w), true); };
    Kernels::SkySeen seen = scene.features.has(feature_emitter_sunsky)
                                ? towards(&Kernels::daylight_seen)
                                : towards(&Kernels::sky_seen);
    return {components(seen.radiance), seen.pdf};
}

SkyDirection sky_chosen(const DeviceScene& scene, std::uint32_t x, std::uint32_t y) {
    SkyKernels k(scene);
    Kernels::Random4 r{0, 0, x, y};
    auto by = [&](auto of) { return (k.*of)(k.tables, k.light, k.texture, r, true); };
    Kernels::EmitterSample s = scene.features.has(feature_emitter_sunsky)
                                   ? by(&Kernels::daylight_chosen)
                                   : by(&Kernels::sky_chosen);
    return {components(s.wi), components(s.weight), s.inverse_pdf};
}

FilterOffset sample_filter(std::span<const FilterBin> table, float u) {
    Kernels k = kernels_with(feature_filter_sampling);
    Kernels::FilterSample s = k.filter_sample(table.data(), static_cast<int>(table.size()) - 1, u);
    return {s.offset, s.weight};
}

} // namespace parhelion

#include "host/twin/opencl_names_end.h"
