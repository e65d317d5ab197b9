// The scene as the device reads it: shapes to primitives, then everything else from its own
// builder.
#include "host/flatten/device_scene.h"

#include "host/flatten/energy_table.h"
#include "host/flatten/filter_table.h"
#include "host/flatten/light_table.h"
#include "host/flatten/material_records.h"
#include "host/flatten/rounding_notes.h"
#include "host/flatten/scene_arrays.h"
#include "host/flatten/scene_features.h"
#include "host/parallel.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include <algorithm>
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

/// What is read of meshes beside the corners of their triangles.
struct VertexUse {
    bool any = false; ///< by some mesh
    bool uvs = false; ///< by lobes that lie along them, and by their AOV
};

VertexUse vertex_use(const Scene& scene, const std::vector<MaterialRecord>& materials) {
    auto lies = [](const MaterialRecord& m) { return m.alpha_u != m.alpha_v; };
    auto is_uv = [](const AovRequest& a) { return a.kind == "uv"; };
    const auto& aovs = scene.integrator.aovs;
    VertexUse use;
    use.uvs = std::any_of(materials.begin(), materials.end(), lies) ||
              std::any_of(aovs.begin(), aovs.end(), is_uv);
    use.any = std::any_of(scene.shapes.begin(), scene.shapes.end(), [&](const Shape& shape) {
        const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
        return mesh && (!mesh->normals.empty() || (use.uvs && !mesh->uvs.empty()));
    });
    return use;
}

/// Of the triangle that the record holds. Not inlined: where g++ 12 sees corners rounded to float
/// and taken back to double, its vectors leave the rounding out (at -O2), and other compilers give
/// other bits.
[[gnu::noinline]] float inverse_normal_length_of(const PrimitiveRecord& p) {
    const glm::dvec3 a(p.ax, p.ay, p.az);
    return inverse_normal_length(glm::dvec3(p.bx, p.by, p.bz) - a,
                                 glm::dvec3(p.cx, p.cy, p.cz) - a);
}

void add_shape(const Mesh& mesh, const Shape& shape, int index, VertexUse use, DeviceScene& out) {
    int flags = (mesh.normals.empty() ? 0 : PRIMITIVE_NORMALS) |
                (mesh.uvs.empty() || !use.uvs ? 0 : PRIMITIVE_UVS);
    std::size_t first = out.primitives.size();
    out.primitives.resize(first + mesh.triangles.size());
    if (use.any) out.vertices.resize(out.primitives.size());
    parallel_for(mesh.triangles.size(), [&](std::size_t i) {
        const glm::uvec3& t = mesh.triangles[i];
        PrimitiveRecord p = primitive(shape, index, geometry_triangle, flags);
        p.index_in_shape = static_cast<int>(i);
        set_points(p, out.frame.point(mesh.positions[t.x]), out.frame.point(mesh.positions[t.y]),
                   out.frame.point(mesh.positions[t.z]));
        p.extra = inverse_normal_length_of(p);
        out.primitives[first + i] = p;
        if (use.any) out.vertices[first + i] = vertex_record(mesh, t);
    });
}

void add_analytic(const PrimitiveRecord& p, VertexUse use, DeviceScene& out) {
    out.primitives.push_back(p);
    if (use.any) out.vertices.push_back({});
}

void add_shape(const Sphere& in_scene, const Shape& shape, int index, VertexUse use,
               DeviceScene& out) {
    Sphere sphere = out.frame.sphere(in_scene);
    PrimitiveRecord p =
        primitive(shape, index, geometry_sphere, sphere.flip_normals ? PRIMITIVE_FLIPPED : 0);
    set_points(p, sphere.center, sphere.axis_x, sphere.axis_z);
    p.extra = static_cast<float>(sphere.radius);
    add_analytic(p, use, out);
}

void add_shape(const Disk& in_scene, const Shape& shape, int index, VertexUse use,
               DeviceScene& out) {
    Disk disk = out.frame.disk(in_scene);
    PrimitiveRecord p =
        primitive(shape, index, geometry_disk, disk.flip_normals ? PRIMITIVE_FLIPPED : 0);
    set_points(p, disk.center, disk.edge_u, disk.edge_v);
    p.extra = inverse_normal_length(disk.edge_u, disk.edge_v);
    add_analytic(p, use, out);
}

std::size_t primitive_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Shape& shape : scene.shapes)
        count += primitive_count(shape);
    return count;
}

/// Primitives a camera ray can meet: all but the emitters where those are hidden, whatever their
/// power.
std::vector<int> seen_by_camera(const Scene& scene, const DeviceScene& device) {
    std::vector<int> subset;
    for (std::size_t i = 0; i < device.primitives.size(); i++)
        if (!scene.shapes[static_cast<std::size_t>(device.primitives[i].shape)].radiance)
            subset.push_back(static_cast<int>(i));
    return subset;
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

static DeviceScene flatten_scene(const Scene& scene, LightChoice choice) {
    std::size_t count = primitive_count(scene);
    constexpr std::size_t most =
        std::numeric_limits<int>::max() / 16; // words of a record are indexed too
    if (count > most)
        throw InputError(fmt::format("{}: {} primitives; the device indexes at most {}", scene.file,
                                     count, most));
    DeviceScene out;
    out.frame = scene_frame(scene);
    out.notes = rounding_notes(scene, out.frame);
    for (const Material& material : scene.materials)
        out.materials.push_back(material_record(material.bsdf));
    VertexUse use = vertex_use(scene, out.materials);
    out.primitives.reserve(count);
    if (use.any) out.vertices.reserve(count);
    for (std::size_t i = 0; i < scene.shapes.size(); i++)
        std::visit(
            [&](const auto& g) { add_shape(g, scene.shapes[i], static_cast<int>(i), use, out); },
            scene.shapes[i].geometry);
    add_light_table(scene, choice, out);
    out.features = scene_features(scene, out);
    add_energy_tables(scene, out);
    decide_energy_compensation(out);
    if (out.features.has(feature_filter_splatting))
        out.filter_values = make_filter_values(scene.film.filter);
    if (out.features.has(feature_filter_sampling))
        out.filter_table = make_filter_table(scene.film.filter);
    return out;
}

DeviceScene make_device_scene(const Scene& scene, LightChoice choice) {
    DeviceScene out = flatten_scene(scene, choice);
    out.root = bvh_append(out.bvh, out.primitives, &out.bvh_statistics);
    out.camera_root = out.root;
    if (scene.integrator.hide_emitters) {
        std::vector<int> visible = seen_by_camera(scene, out);
        if (visible.size() < out.primitives.size())
            out.camera_root = bvh_append(out.bvh, out.primitives, visible, nullptr);
    }
    return out;
}

std::size_t DeviceScene::bytes() const {
    SceneArrays arrays = scene_arrays(*this);
#define ADD_BYTES(type, name) +arrays.name.size_bytes()
    return 0 SCENE_BUFFERS(ADD_BYTES);
}

} // namespace parhelion
