// The arrays of a DeviceScene by the names that kernels know them by (SCENE_BUFFERS).
#pragma once

#include "host/flatten/device_scene.h"

namespace parhelion {

struct SceneArrays {
    const decltype(Bvh::nodes)& bvh_nodes;
    const decltype(Bvh::leaves)& bvh_leaves;
    const LargeVector<PrimitiveRecord>& primitives;
    const LargeVector<VertexRecord>& vertices;
    const std::vector<MaterialRecord>& materials;
    const std::vector<LightRecord>& lights;
    const std::vector<LightNodeRecord>& light_nodes;
    const std::vector<int>& light_leaves;
    const std::vector<float>& energy_tables;
    const std::vector<FilterBin>& filter_table;
    const std::vector<float>& filter_values;
};

/// The table, or one row of zeros where it has none: kernels look at row 0 for lanes that have hit
/// nothing.
template<class Table>
const Table& with_a_row(const Table& table) {
    static const Table zeros(1, typename Table::value_type{});
    return table.empty() ? zeros : table;
}

inline SceneArrays scene_arrays(const DeviceScene& scene) {
    return {scene.bvh.nodes,
            scene.bvh.leaves,
            with_a_row(scene.primitives),
            scene.vertices,
            with_a_row(scene.materials),
            scene.lights,
            scene.light_tree.nodes,
            scene.light_tree.leaves,
            scene.energy_tables,
            scene.filter_table,
            scene.filter_values};
}

} // namespace parhelion
