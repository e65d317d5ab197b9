// The scene as the device reads it: shapes to primitives, then everything else from its own
// builder.
#include "host/flatten/device_scene.h"

#include "host/flatten/energy_table.h"
#include "host/flatten/filter_table.h"
#include "host/flatten/light_table.h"
#include "host/flatten/lobe_lists.h"
#include "host/flatten/material_records.h"
#include "host/flatten/rounding_notes.h"
#include "host/flatten/scene_arrays.h"
#include "host/flatten/scene_features.h"
#include "host/flatten/shape_records.h"
#include "host/flatten/texture_records.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <type_traits>

namespace parhelion {
namespace {

/// Primitives a camera ray can meet: all but the emitters where those are hidden, whatever their
/// power.
std::vector<int> seen_by_camera(const Scene& scene, const DeviceScene& device) {
    std::vector<int> subset;
    for (std::size_t i = 0; i < scene.shapes.size(); i++) {
        if (scene.shapes[i].radiance) continue;
        int first = device.geometry.shapes[i].first_primitive;
        for (std::size_t k = 0; k < primitive_count(scene.shapes[i]); k++)
            subset.push_back(first + static_cast<int>(k));
    }
    return subset;
}

/// Whether some of what a side is made of is no surface at all.
bool is_clear(const DeviceScene& device, int code) {
    const std::vector<LobeRecord> lobes = lobes_of(device, code);
    return std::any_of(lobes.begin(), lobes.end(), [&](const LobeRecord& lobe) {
        return device.materials[static_cast<std::size_t>(lobe.material)].kind == material_null;
    });
}

/// Shadow rays that nothing opaque stops go through what is clear, one surface after the other.
void add_shadow_trees(DeviceScene& device) {
    std::map<int, bool> clear_codes;
    std::vector<int> blocking, clear;
    for (std::size_t i = 0; i < device.geometry.primitives.size(); i++) {
        int code = device.geometry.primitives[i].material;
        const auto [found, added] = clear_codes.try_emplace(code);
        if (added) found->second = is_clear(device, code);
        (found->second ? clear : blocking).push_back(static_cast<int>(i));
    }
    device.blocking_root = bvh_append(device.bvh, device.geometry, blocking);
    device.clear_root = bvh_append(device.bvh, device.geometry, clear);
}

} // namespace

float inverse_normal_length(const glm::dvec3& u, const glm::dvec3& v) {
    double inverse = 1.0 / glm::length(glm::cross(u, v));
    return inverse <= double{std::numeric_limits<float>::max()} ? static_cast<float>(inverse) : 0.f;
}

std::size_t primitive_count(const Shape& shape) {
    const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
    return mesh ? mesh->triangles.size() : 1;
}

DeviceScene flatten_scene(const Scene& scene, LightChoice choice, DeviceScene* before) {
    DeviceScene out;
    out.frame = scene_frame(scene);
    out.notes = rounding_notes(scene, out.frame);
    for (const Material& material : scene.materials)
        out.materials.push_back(material_record(material.bsdf));
    add_textures(scene, before, out);
    add_shapes(scene, out);
    add_lobes(scene, out);
    add_light_table(scene, choice, out);
    out.features = scene_features(scene, out);
    add_energy_tables(scene, out);
    decide_energy_compensation(scene, out);
    if (out.features.has(feature_filter_splatting))
        out.filter_values = make_filter_values(scene.film.filter);
    if (out.features.has(feature_filter_sampling))
        out.filter_table = make_filter_table(scene.film.filter);
    return out;
}

DeviceScene make_device_scene(const Scene& scene, LightChoice choice, DeviceScene* before) {
    DeviceScene out = flatten_scene(scene, choice, before);
    out.root = bvh_append(out.bvh, out.geometry, &out.bvh_statistics);
    out.camera_root = out.blocking_root = out.clear_root = out.root;
    if (out.features.has(feature_clear_shadows)) add_shadow_trees(out);
    if (scene.integrator.hide_emitters) {
        std::vector<int> visible = seen_by_camera(scene, out);
        if (visible.size() < out.geometry.primitives.size())
            out.camera_root = bvh_append(out.bvh, out.geometry, visible, nullptr);
    }
    return out;
}

std::size_t DeviceScene::bytes() const {
    SceneArrays arrays = scene_arrays(*this);
#define ADD_BYTES(type, name) +arrays.name.size_bytes()
    return 0 SCENE_BUFFERS(ADD_BYTES);
}

} // namespace parhelion
