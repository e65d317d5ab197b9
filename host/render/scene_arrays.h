// The arrays of a DeviceScene by the names that kernels know them by (SCENE_BUFFERS).
#pragma once

#include "host/render/device_scene.h"

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

inline SceneArrays scene_arrays(const DeviceScene& scene) {
    return {scene.bvh.nodes,        scene.bvh.leaves,        scene.primitives,
            scene.vertices,         scene.materials,         scene.lights,
            scene.light_tree.nodes, scene.light_tree.leaves, scene.energy_tables,
            scene.filter_table,     scene.filter_values};
}

} // namespace parhelion
