// The scene as the device reads it: shapes to primitives, then everything else from its own
// builder.
#include "host/render/device_scene.h"

#include "host/parallel.h"
#include "host/render/energy_table.h"
#include "host/render/filter_table.h"
#include "host/render/light_table.h"
#include "host/render/material_records.h"
#include "host/render/scene_features.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include <limits>
#include <type_traits>

namespace parhelion {
namespace {

struct Position {
    float x, y, z;
};

Position to_float(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

PrimitiveRecord primitive(const Shape& shape, int shape_index, GeometryKind kind, int flags) {
    PrimitiveRecord p{};
    p.material_front = shape.material_front;
    p.material_back = shape.material_back;
    p.light = -1;
    p.shape = shape_index;
    p.flags = kind | flags;
    return p;
}

void set_points(PrimitiveRecord& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    Position fa = to_float(a), fb = to_float(b), fc = to_float(c);
    p.ax = fa.x, p.ay = fa.y, p.az = fa.z;
    p.bx = fb.x, p.by = fb.y, p.bz = fb.z;
    p.cx = fc.x, p.cy = fc.y, p.cz = fc.z;
}

VertexRecord vertex_record(const Mesh& mesh, const glm::uvec3& t) {
    VertexRecord v{};
    if (!mesh.normals.empty()) {
        Position a = to_float(mesh.normals[t.x]), b = to_float(mesh.normals[t.y]),
                 c = to_float(mesh.normals[t.z]);
        v.n0x = a.x, v.n0y = a.y, v.n0z = a.z;
        v.n1x = b.x, v.n1y = b.y, v.n1z = b.z;
        v.n2x = c.x, v.n2y = c.y, v.n2z = c.z;
    }
    if (!mesh.uvs.empty()) {
        v.u0 = static_cast<float>(mesh.uvs[t.x].x), v.v0 = static_cast<float>(mesh.uvs[t.x].y);
        v.u1 = static_cast<float>(mesh.uvs[t.y].x), v.v1 = static_cast<float>(mesh.uvs[t.y].y);
        v.u2 = static_cast<float>(mesh.uvs[t.z].x), v.v2 = static_cast<float>(mesh.uvs[t.z].y);
    }
    return v;
}

bool has_vertices(const DeviceScene& scene) {
    return scene.features & (feature_bit(feature_vertex_normals) | feature_bit(feature_vertex_uvs));
}

void add_shape(const Mesh& mesh, const Shape& shape, int index, DeviceScene& out) {
    int flags =
        (mesh.normals.empty() ? 0 : PRIMITIVE_NORMALS) | (mesh.uvs.empty() ? 0 : PRIMITIVE_UVS);
    bool attributes = has_vertices(out);
    std::size_t first = out.primitives.size();
    out.primitives.resize(first + mesh.triangles.size());
    if (attributes) out.vertices.resize(out.primitives.size());
    parallel_for(mesh.triangles.size(), [&](std::size_t i) {
        const glm::uvec3& t = mesh.triangles[i];
        PrimitiveRecord p = primitive(shape, index, geometry_triangle, flags);
        p.index_in_shape = static_cast<int>(i);
        set_points(p, out.frame.point(mesh.positions[t.x]), out.frame.point(mesh.positions[t.y]),
                   out.frame.point(mesh.positions[t.z]));
        glm::dvec3 a(p.ax, p.ay, p.az);
        p.extra = inverse_normal_length(glm::dvec3(p.bx, p.by, p.bz) - a,
                                        glm::dvec3(p.cx, p.cy, p.cz) - a);
        out.primitives[first + i] = p;
        if (attributes) out.vertices[first + i] = vertex_record(mesh, t);
    });
}

void add_analytic(const PrimitiveRecord& p, DeviceScene& out) {
    out.primitives.push_back(p);
    if (has_vertices(out)) out.vertices.push_back({});
}

void add_shape(const Sphere& in_scene, const Shape& shape, int index, DeviceScene& out) {
    Sphere sphere = out.frame.sphere(in_scene);
    PrimitiveRecord p =
        primitive(shape, index, geometry_sphere, sphere.flip_normals ? PRIMITIVE_FLIPPED : 0);
    set_points(p, sphere.center, sphere.axis_x, sphere.axis_z);
    p.extra = static_cast<float>(sphere.radius);
    add_analytic(p, out);
}

void add_shape(const Disk& in_scene, const Shape& shape, int index, DeviceScene& out) {
    Disk disk = out.frame.disk(in_scene);
    PrimitiveRecord p =
        primitive(shape, index, geometry_disk, disk.flip_normals ? PRIMITIVE_FLIPPED : 0);
    set_points(p, disk.center, disk.edge_u, disk.edge_v);
    p.extra = inverse_normal_length(disk.edge_u, disk.edge_v);
    add_analytic(p, out);
}

std::size_t primitive_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Shape& shape : scene.shapes) {
        const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
        count += mesh ? mesh->triangles.size() : 1;
    }
    return count;
}

/// Primitives a camera ray can meet: all but the emitters where those are hidden.
std::vector<int> seen_by_camera(const DeviceScene& scene) {
    std::vector<int> subset;
    for (std::size_t i = 0; i < scene.primitives.size(); i++)
        if (scene.primitives[i].light < 0) subset.push_back(static_cast<int>(i));
    return subset;
}

} // namespace

float inverse_normal_length(const glm::dvec3& u, const glm::dvec3& v) {
    double inverse = 1.0 / glm::length(glm::cross(u, v));
    return inverse <= double{std::numeric_limits<float>::max()} ? static_cast<float>(inverse) : 0.f;
}

static DeviceScene flatten_scene(const Scene& scene, LightChoice choice) {
    std::size_t count = primitive_count(scene);
    constexpr std::size_t most =
        std::numeric_limits<int>::max() / 16; // words of a record are indexed too
    if (count > most)
        throw InputError(fmt::format("{}: {} primitives; the device indexes at most {}", scene.file,
                                     count, most));
    DeviceScene out;
    out.frame = scene_frame(scene);
    out.features = scene_features(scene, out.frame);
    out.primitives.reserve(count);
    if (has_vertices(out)) out.vertices.reserve(count);
    for (std::size_t i = 0; i < scene.shapes.size(); i++)
        std::visit([&](const auto& g) { add_shape(g, scene.shapes[i], static_cast<int>(i), out); },
                   scene.shapes[i].geometry);
    for (const Material& material : scene.materials)
        out.materials.push_back(material_record(material.bsdf));
    if (out.features & feature_bit(feature_energy_compensation)) add_energy_tables(scene, out);
    add_light_table(scene, choice, out);
    if (!out.light_tree.nodes.empty()) out.features |= light_tree_features(out.features);
    if (out.features & feature_bit(feature_filter_splatting))
        out.filter_values = make_filter_values(scene.film.filter);
    if (out.features & feature_bit(feature_filter_sampling))
        out.filter_table = make_filter_table(scene.film.filter);
    return out;
}

DeviceScene make_device_scene(const Scene& scene, LightChoice choice) {
    DeviceScene out = flatten_scene(scene, choice);
    out.root = bvh_append(out.bvh, out.primitives, &out.bvh_statistics);
    out.camera_root = out.root;
    if (scene.integrator.hide_emitters) {
        std::vector<int> visible = seen_by_camera(out);
        if (visible.size() < out.primitives.size())
            out.camera_root = bvh_append(out.bvh, out.primitives, visible, nullptr);
    }
    return out;
}

std::size_t DeviceScene::bytes() const {
    auto size = [](const auto& v) { return v.size() * sizeof(v[0]); };
    return size(primitives) + size(vertices) + size(materials) + size(lights) +
           size(light_tree.nodes) + size(light_tree.leaves) + size(energy_tables) +
           size(filter_table) + size(filter_values) + size(bvh.nodes) + size(bvh.leaves);
}

} // namespace parhelion
