// The arrays of a DeviceScene by the names that kernels know them by (SCENE_BUFFERS).
#pragma once

#include "host/flatten/device_scene.h"

#include <span>

namespace parhelion {

#define SCENE_SPAN(type, name) std::span<const type> name;
/// Into a DeviceScene that must outlive them and not change.
struct SceneArrays {
    SCENE_BUFFERS(SCENE_SPAN)
};
#undef SCENE_SPAN

/// The table, or one row of zeros where it has none: kernels look at row 0 for lanes that have hit
/// nothing.
template<class Table>
std::span<const typename Table::value_type> with_a_row(const Table& table) {
    static const typename Table::value_type zeros{};
    if (table.empty()) return {&zeros, 1};
    return table;
}

inline SceneArrays scene_arrays(const DeviceScene& scene) {
    return {scene.bvh.nodes,
            scene.bvh.leaves,
            with_a_row(scene.geometry.primitives),
            scene.geometry.points,
            with_a_row(scene.geometry.shapes),
            with_a_row(scene.materials),
            with_a_row(scene.lobes),
            with_a_row(scene.material_textures),
            with_a_row(scene.textures),
            scene.texels,
            scene.byte_values,
            scene.lights,
            scene.light_textures,
            scene.light_tree.nodes,
            scene.light_tree.leaves,
            scene.light_groups,
            scene.environment.shares,
            scene.energy_tables,
            scene.filter_table,
            scene.filter_values};
}

} // namespace parhelion
