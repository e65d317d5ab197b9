// Functions of the kernels that read tables, as C++ in single precision.
#include "host/twin/device_functions.h"
#include "host/twin/work_item.h"

#include "host/twin/opencl_names.h"

namespace parhelion {
namespace {

struct Kernels : WorkItem {
#define PARHELION_REAL float
#include "kernels/generate.cl"
// And of shading:
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

FilterOffset sample_filter(std::span<const FilterBin> table, float u) {
    Kernels k = kernels_with(feature_filter_sampling);
    Kernels::FilterSample s = k.filter_sample(table.data(), static_cast<int>(table.size()) - 1, u);
    return {s.offset, s.weight};
}

} // namespace parhelion

#include "host/twin/opencl_names_end.h"
