// What the host tells the device of shapes, by what was put in: points with their normals and
// texture coordinates, who shares them, and what primitives and shapes say.
#include "host/flatten/device_scene.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/measure.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

/// Two triangles with an edge in common.
Mesh smooth_mesh() {
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {3, 0, 1}, {3, 2, 0}, {0, 2, 1}};
    for (std::size_t i = 0; i < mesh.positions.size(); i++) {
        mesh.normals.push_back(glm::normalize(glm::dvec3(0.1 * double(i), 0.2, 1)));
        mesh.uvs.emplace_back(0.1 * double(i), 1 - 0.1 * double(i));
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

/// Without normals and coordinates, which another mesh of the scene has.
Mesh plain_mesh() {
    Mesh mesh;
    mesh.positions = {{0, 0, 4}, {4, 0, 4}, {0, 3, 4}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

Scene scene_of(const std::vector<Geometry>& shapes, bool asks_for_uvs) {
    Scene scene;
    scene.file = "made by the test";
    scene.materials = {{"", {}, DiffuseBsdf{}}, {"", {}, DiffuseBsdf{}}, {"", {}, NullBsdf{}}};
    for (std::size_t i = 0; i < shapes.size(); i++)
        scene.shapes.push_back(shape_of(shapes[i], int(i) % 3, int(i) % 3 - 1));
    if (asks_for_uvs) scene.integrator.aovs = {{"uv", "uv", {}}};
    return scene;
}

Approx near(double value) { return Approx(value).epsilon(1e-6).margin(1e-6); }

void check_words(const float* words, std::initializer_list<double> expected) {
    for (double value : expected)
        CHECK(*words++ == near(value));
}

void check_corner(const DeviceScene& device, int point, const Mesh& mesh, std::uint32_t vertex) {
    INFO("vertex " << vertex);
    const float* words = &device.geometry.points[std::size_t(point)];
    glm::dvec3 p = device.frame.point(mesh.positions[vertex]), n(0);
    glm::dvec2 uv(0);
    if (!mesh.normals.empty()) n = mesh.normals[vertex];
    if (!mesh.uvs.empty()) uv = mesh.uvs[vertex];
    check_words(words, {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y});
}

double twice_area(const DeviceScene& device, const Mesh& mesh, const glm::uvec3& t) {
    auto at = [&](std::uint32_t vertex) { return device.frame.point(mesh.positions[vertex]); };
    return glm::length(glm::cross(at(t.y) - at(t.x), at(t.z) - at(t.x)));
}

} // namespace

TEST_CASE("Shape truths: corners with their normals and coordinates", "[truths]") {
    const Mesh first = smooth_mesh(), second = plain_mesh();
    DeviceScene device = make_device_scene(scene_of({first, second}, true));
    const IndexedGeometry& g = device.geometry;
    // Four and three vertices, a point of padding, a word.
    CHECK(g.points.size() == (4 + 3 + 1) * POINT_WORDS(1, 1) + 1);
    REQUIRE(g.primitives.size() == 3);
    for (int i = 0; i < 3; i++) {
        const Mesh& mesh = i < 2 ? first : second;
        const glm::uvec3& t = mesh.triangles[std::size_t(i % 2)];
        const IndexedPrimitiveRecord& p = g.primitives[std::size_t(i)];
        check_corner(device, p.a, mesh, t.x);
        check_corner(device, p.b, mesh, t.y);
        check_corner(device, p.c, mesh, t.z);
        CHECK(p.extra * twice_area(device, mesh, t) == near(1));
        CHECK(g.shape_of(i) == i / 2);
        CHECK(g.index_in_shape(i) == i % 2);
        CHECK(p.material == i / 2);
        CHECK(PRIMITIVE_FLAGS(p.shape) == (i < 2 ? PRIMITIVE_NORMALS | PRIMITIVE_UVS : 0));
    }
    CHECK(g.primitives[0].a == g.primitives[1].a);
    CHECK(g.primitives[0].c == g.primitives[1].b);
}

TEST_CASE("Shape truths: nothing is kept that nothing reads", "[truths]") {
    Mesh mesh = smooth_mesh();
    CHECK(make_device_scene(scene_of({mesh}, false)).geometry.points.size() ==
          5 * POINT_WORDS(1, 0) + 1);
    mesh.normals.clear();
    CHECK(make_device_scene(scene_of({mesh}, true)).geometry.points.size() ==
          5 * POINT_WORDS(0, 1) + 1);
    CHECK(make_device_scene(scene_of({mesh}, false)).geometry.points.size() ==
          5 * POINT_WORDS(0, 0) + 1);
}

TEST_CASE("Shape truths: spheres and disks beside meshes", "[truths]") {
    Sphere sphere{{1, 2, 3}, 0.5};
    Disk disk{{-1, 0, 2}, {0.5, 0, 0}, {0, 0.25, 0.1}, true};
    DeviceScene device = make_device_scene(scene_of({smooth_mesh(), sphere, disk}, true));
    const IndexedGeometry& g = device.geometry;
    REQUIRE(g.primitives.size() == 4);
    PrimitiveRecord s = g.primitive(2), d = g.primitive(3);
    double scale = device.frame.scale;
    glm::dvec3 centre = device.frame.point(sphere.center), middle = device.frame.point(disk.center);
    check_words(&s.ax, {centre.x, centre.y, centre.z, 1, 0, 0, 0, 0, 1, 0.5 * scale});
    check_words(&d.ax, {middle.x, middle.y, middle.z, 0.5 * scale, 0, 0, 0, 0.25 * scale,
                        0.1 * scale, 1 / (0.5 * std::hypot(0.25, 0.1) * scale * scale)});
    CHECK(s.flags == geometry_sphere);
    CHECK(d.flags == (geometry_disk | PRIMITIVE_FLIPPED));
    CHECK(g.shapes[1].material_front == 1);
    CHECK(g.shapes[1].material_back == 0);
    CHECK(g.shapes[2].material_front == 2);
    CHECK(g.shapes[2].first_primitive == 3);
    CHECK(g.index_in_shape(3) == 0);
}
