// Shapes of a scene as the device stores them: primitives, points and what they have beside.
#include "host/flatten/shape_records.h"

#include "host/error.h"
#include "host/flatten/texture_records.h"
#include "host/parallel.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <variant>

namespace parhelion {
namespace {

template<int N>
void write(const glm::vec<N, double>& v, float* to) {
    for (int k = 0; k < N; k++)
        to[k] = static_cast<float>(v[k]);
}

/// What points have beside: whether any mesh has it, and something reads it.
struct Attributes {
    bool normals = false;
    bool uvs = false; ///< read by lobes that lie along them, by textures, and by their AOV

    std::size_t point_words() const { return POINT_WORDS(normals, uvs); }
};

Attributes attributes_of(const Scene& scene, const DeviceScene& records) {
    bool read = has_anisotropic(records) || reads_uvs(scene, records);
    Attributes some;
    for (const Shape& shape : scene.shapes)
        if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
            mesh && !mesh->triangles.empty()) {
            some.normals |= !mesh->normals.empty();
            some.uvs |= read && !mesh->uvs.empty();
        }
    return some;
}

ShapeRecord shape_record(const Shape& shape, int flags, const IndexedGeometry& geometry) {
    ShapeRecord s{};
    s.flags = flags;
    s.material_front = shape.material_front;
    s.material_back = shape.material_back;
    s.first_primitive = static_cast<int>(geometry.primitives.size());
    return s;
}

/// The place of the first.
std::size_t add_points(const Mesh& mesh, Attributes some, DeviceScene& out) {
    auto& points = out.geometry.points;
    std::size_t first = points.size(), words = some.point_words();
    points.resize(first + mesh.positions.size() * words);
    parallel_for(mesh.positions.size(), [&](std::size_t v) {
        float* point = &points[first + v * words];
        write(out.frame.point(mesh.positions[v]), point);
        if (some.normals)
            write(mesh.normals.empty() ? glm::dvec3(0.0) : mesh.normals[v], point + POINT_NORMAL);
        if (some.uvs)
            write(mesh.uvs.empty() ? glm::dvec2(0.0) : mesh.uvs[v], point + POINT_UV(some.normals));
    });
    return first;
}

/// Of the triangle that the record holds. Not inlined: where g++ 12 sees corners rounded to float
/// and taken back to double, its vectors leave the rounding out (at -O2), and other compilers give
/// other bits.
[[gnu::noinline]] float inverse_normal_length_of(const PrimitiveRecord& p) {
    const glm::dvec3 a(p.ax, p.ay, p.az);
    return inverse_normal_length(glm::dvec3(p.bx, p.by, p.bz) - a,
                                 glm::dvec3(p.cx, p.cy, p.cz) - a);
}

/// Of the last shape that there is.
IndexedPrimitiveRecord primitive(std::size_t a, std::size_t b, std::size_t c, float extra,
                                 const IndexedGeometry& geometry) {
    auto number = static_cast<int>(geometry.shapes.size()) - 1;
    const ShapeRecord& shape = geometry.shapes.back();
    return {static_cast<int>(a),
            static_cast<int>(b),
            static_cast<int>(c),
            extra,
            (number << PRIMITIVE_FLAG_BITS) | shape.flags,
            shape.material_front,
            -1};
}

void add_triangles(const Mesh& mesh, std::size_t first_point, std::size_t point_words,
                   IndexedGeometry& out) {
    std::size_t first = out.primitives.size();
    out.primitives.resize(first + mesh.triangles.size());
    parallel_for(mesh.triangles.size(), [&](std::size_t i) {
        auto place = [&](std::uint32_t vertex) { return first_point + vertex * point_words; };
        const glm::uvec3& t = mesh.triangles[i];
        auto number = static_cast<int>(first + i);
        out.primitives[first + i] = primitive(place(t.x), place(t.y), place(t.z), 0.f, out);
        out.primitives[first + i].extra = inverse_normal_length_of(out.primitive(number));
    });
}

void add_shape(const Mesh& mesh, const Shape& shape, Attributes some, DeviceScene& out) {
    int flags = geometry_triangle | (mesh.normals.empty() ? 0 : PRIMITIVE_NORMALS) |
                (mesh.uvs.empty() || !some.uvs ? 0 : PRIMITIVE_UVS);
    std::size_t first = add_points(mesh, some, out);
    out.geometry.shapes.push_back(shape_record(shape, flags, out.geometry));
    add_triangles(mesh, first, some.point_words(), out.geometry);
}

/// A shape of one primitive with three points of its own.
void add_analytic(const ShapeRecord& record, const std::array<glm::dvec3, 3>& points, float extra,
                  Attributes some, DeviceScene& out) {
    IndexedGeometry& to = out.geometry;
    std::size_t words = some.point_words(), first = to.points.size();
    to.shapes.push_back(record);
    to.points.insert(to.points.end(), points.size() * words, 0.f);
    for (std::size_t i = 0; i < points.size(); i++)
        write(points[i], &to.points[first + i * words]);
    to.primitives.push_back(primitive(first, first + words, first + 2 * words, extra, to));
}

void add_shape(const Sphere& in_scene, const Shape& shape, Attributes some, DeviceScene& out) {
    Sphere sphere = out.frame.sphere(in_scene);
    int flags = geometry_sphere | (sphere.flip_normals ? PRIMITIVE_FLIPPED : 0);
    add_analytic(shape_record(shape, flags, out.geometry),
                 {sphere.center, sphere.axis_x, sphere.axis_z}, static_cast<float>(sphere.radius),
                 some, out);
}

void add_shape(const Disk& in_scene, const Shape& shape, Attributes some, DeviceScene& out) {
    Disk disk = out.frame.disk(in_scene);
    int flags = geometry_disk | (disk.flip_normals ? PRIMITIVE_FLIPPED : 0);
    add_analytic(shape_record(shape, flags, out.geometry), {disk.center, disk.edge_u, disk.edge_v},
                 inverse_normal_length(disk.edge_u, disk.edge_v), some, out);
}

void add_shape(const Cylinder& in_scene, const Shape& shape, Attributes some, DeviceScene& out) {
    Cylinder c = out.frame.cylinder(in_scene);
    int flags = geometry_cylinder | (c.flip_normals ? PRIMITIVE_FLIPPED : 0);
    double radius = glm::length(c.side);
    add_analytic(shape_record(shape, flags, out.geometry), {c.base, c.axis, c.side},
                 static_cast<float>(c.mirrored ? -radius : radius), some, out);
}

/// Arrays that grow would be copied, and have room to spare in the end.
void reserve(const Scene& scene, Attributes some, DeviceScene& out) {
    std::size_t primitives = 0, points = 0;
    for (const Shape& shape : scene.shapes) {
        const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
        primitives += primitive_count(shape);
        points += mesh ? mesh->positions.size() : 3;
    }
    constexpr std::size_t most = std::numeric_limits<int>::max();
    if (primitives > most / 16)
        throw InputError(fmt::format("{}: {} primitives; the device indexes at most {}", scene.file,
                                     primitives, most / 16));
    constexpr std::size_t most_shapes = most >> PRIMITIVE_FLAG_BITS;
    if (scene.shapes.size() > most_shapes)
        throw InputError(fmt::format("{}: {} shapes; the device numbers at most {}", scene.file,
                                     scene.shapes.size(), most_shapes));
    if (points > most / some.point_words())
        throw InputError(fmt::format("{}: {} vertices; the device indexes at most {}", scene.file,
                                     points, most / some.point_words()));
    out.geometry.primitives.reserve(primitives);
    out.geometry.points.reserve((points + 1) * some.point_words() + 1);
    out.geometry.shapes.reserve(scene.shapes.size());
}

} // namespace

void add_shapes(const Scene& scene, DeviceScene& out) {
    Attributes some = attributes_of(scene, out);
    reserve(scene, some, out);
    for (const Shape& shape : scene.shapes)
        std::visit([&](const auto& g) { add_shape(g, shape, some, out); }, shape.geometry);
    // What lanes that have hit nothing look at where there is nothing, and a word more.
    out.geometry.points.insert(out.geometry.points.end(), some.point_words() + 1, 0.f);
}

} // namespace parhelion
