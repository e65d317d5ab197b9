// The geometry of shapes: placement, normals and sides. Orientations and smooth normals are those
// of Mitsuba 3.9.1, whose shading normal decides which side of a surface is its front.
#include "test_scene_tools.h"

#include <glm/geometric.hpp>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

const std::string mirror_x = "<transform name=\"to_world\"><scale x=\"-1\"/></transform>";
const std::string mirror_z = "<transform name=\"to_world\"><scale z=\"-1\"/></transform>";
const std::string flip = "<boolean name=\"flip_normals\" value=\"true\"/>";
const std::string flat = "<boolean name=\"face_normals\" value=\"true\"/>";

template<typename T>
T shape_of(const std::string& plugin, const std::string& parameters = "") {
    return std::get<T>(
        load_body("<shape type=\"" + plugin + "\">" + parameters + "</shape>").shapes[0].geometry);
}

glm::dvec3 face_normal(const Mesh& mesh, std::size_t triangle) {
    const glm::uvec3 t = mesh.triangles.at(triangle);
    return glm::normalize(glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                     mesh.positions[t[2]] - mesh.positions[t[0]]));
}

/// The mesh of an OBJ file of this content.
Mesh obj_of(const std::string& content, const std::string& parameters = "") {
    const SceneFolder folder;
    folder.write("mesh.obj", content);
    const std::string body = "<shape type=\"obj\"><string name=\"filename\" value=\"mesh.obj\"/>" +
                             parameters + "</shape>";
    const Scene scene = load_scene(folder.write("scene.xml", scene_text(body)));
    return std::get<Mesh>(scene.shapes[0].geometry);
}

const std::string quad = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
const std::string quad_with_normals = quad + "vn 0 0 1\nf 1//1 2//1 3//1 4//1\n";
const std::string quad_without = quad + "f 1 2 3 4\n";

double disk_side(const Disk& disk) {
    return glm::normalize(glm::cross(disk.edge_u, disk.edge_v)).z * (disk.flip_normals ? -1 : 1);
}

} // namespace

TEST_CASE("scene shapes: rectangle") {
    const Mesh mesh = shape_of<Mesh>("rectangle");
    CHECK(mesh.triangles.size() == 2);
    CHECK(mesh.normals.empty());
    REQUIRE(mesh.uvs.size() == mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        CHECK(mesh.positions[i].z == 0.0);
        CHECK(mesh.uvs[i] == (glm::dvec2(mesh.positions[i]) + 1.0) / 2.0);
    }
    CHECK(face_normal(mesh, 0) == glm::dvec3(0, 0, 1));
    CHECK(face_normal(mesh, 1) == glm::dvec3(0, 0, 1));
}

TEST_CASE("scene shapes: cube, every face outwards with the whole texture") {
    const Mesh mesh = shape_of<Mesh>("cube");
    REQUIRE(mesh.triangles.size() == 12);
    glm::dvec3 area(0.0);
    for (std::size_t i = 0; i < 12; ++i) {
        const glm::uvec3 t = mesh.triangles[i];
        const glm::dvec3 middle =
            (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
        CHECK(glm::dot(face_normal(mesh, i), middle) == Approx(1.0));
        const glm::dvec2 a = mesh.uvs[t[1]] - mesh.uvs[t[0]], b = mesh.uvs[t[2]] - mesh.uvs[t[0]];
        CHECK(std::abs(a.x * b.y - a.y * b.x) == 1.0);
        area += glm::abs(face_normal(mesh, i));
    }
    CHECK(area == glm::dvec3(4.0));
    // As in Mitsuba: the first face is y = -1, its first vertex (1, -1, -1) with uv (0, 1).
    CHECK(mesh.positions[0] == glm::dvec3(1, -1, -1));
    CHECK(mesh.uvs[0] == glm::dvec2(0, 1));
    CHECK(face_normal(mesh, 0) == glm::dvec3(0, -1, 0));
}

TEST_CASE("scene shapes: a mirror keeps the front of what has normals of its own") {
    const auto side = [](const std::string& parameters) {
        return face_normal(shape_of<Mesh>("rectangle", parameters), 0).z;
    };
    CHECK(side("") == 1.0);
    CHECK(side(mirror_x) == 1.0);
    CHECK(side(mirror_z) == -1.0);
    CHECK(side(flip) == -1.0);
    CHECK(side(flip + mirror_x) == -1.0);
    CHECK(side(flip + mirror_z) == 1.0);
    CHECK(side(flat + mirror_x) == 1.0);
    for (const std::string& m : {mirror_x, mirror_z, mirror_x + flat}) {
        const Mesh cube = shape_of<Mesh>("cube", m);
        for (std::size_t i = 0; i < 12; ++i)
            CHECK(glm::dot(face_normal(cube, i), cube.positions[cube.triangles[i][0]]) > 0.0);
    }
    CHECK(disk_side(shape_of<Disk>("disk")) == 1.0);
    CHECK(disk_side(shape_of<Disk>("disk", mirror_x)) == 1.0);
    CHECK(disk_side(shape_of<Disk>("disk", mirror_z)) == -1.0);
    CHECK(disk_side(shape_of<Disk>("disk", flip + mirror_x)) == -1.0);
    CHECK(disk_side(shape_of<Disk>("disk", flip)) == -1.0);
}

TEST_CASE("scene shapes: a mirror turns a sphere inside out, as in Mitsuba") {
    CHECK_FALSE(shape_of<Sphere>("sphere").flip_normals);
    CHECK(shape_of<Sphere>("sphere", flip).flip_normals);
    CHECK(shape_of<Sphere>("sphere", mirror_x).flip_normals);
    CHECK_FALSE(shape_of<Sphere>("sphere", flip + mirror_x).flip_normals);
}

TEST_CASE("scene shapes: the mirror of an OBJ follows its normals, or its winding without them") {
    CHECK(face_normal(obj_of(quad_with_normals), 0).z == 1.0);
    CHECK(face_normal(obj_of(quad_with_normals, mirror_x), 0).z == 1.0);
    CHECK(face_normal(obj_of(quad_with_normals, mirror_z), 0).z == -1.0);
    CHECK(face_normal(obj_of(quad_with_normals, mirror_x + flip), 0).z == -1.0);
    CHECK(face_normal(obj_of(quad_with_normals, mirror_x + flat), 0).z == -1.0);
    CHECK(face_normal(obj_of(quad_without, mirror_x), 0).z == -1.0);
    CHECK(face_normal(obj_of(quad_without, mirror_z), 0).z == 1.0);
    CHECK(face_normal(obj_of(quad_without, mirror_x + flat), 0).z == -1.0);
    CHECK(obj_of(quad_without, mirror_x).normals[0] == glm::dvec3(0, 0, -1));
    CHECK(obj_of(quad_without, flip).normals[0] == glm::dvec3(0, 0, -1));
    CHECK(obj_of(quad_with_normals, flat).normals.empty());
    CHECK(obj_of(quad_without, flat).normals.empty());
}

TEST_CASE("scene shapes: sphere under transforms") {
    const Sphere sphere = shape_of<Sphere>(
        "sphere", "<point name=\"center\" value=\"1 2 3\"/><float name=\"radius\" value=\"2\"/>"
                  "<transform name=\"to_world\"><scale value=\"2\"/><rotate z=\"1\" angle=\"90\"/>"
                  "<translate z=\"1\"/></transform>");
    CHECK(sphere.center == glm::dvec3(-4, 2, 7));
    CHECK(sphere.radius == 4.0);
    CHECK(sphere.axis_x == glm::dvec3(0, 1, 0));
    CHECK(sphere.axis_y == glm::dvec3(-1, 0, 0));
    CHECK(sphere.axis_z == glm::dvec3(0, 0, 1));
}

TEST_CASE("scene shapes: disk under transforms becomes an ellipse") {
    const Disk disk = shape_of<Disk>("disk", "<transform name=\"to_world\"><scale x=\"2\" y=\"3\"/>"
                                             "<translate value=\"1 2 3\"/></transform>");
    CHECK(disk.center == glm::dvec3(1, 2, 3));
    CHECK(disk.edge_u == glm::dvec3(2, 0, 0));
    CHECK(disk.edge_v == glm::dvec3(0, 3, 0));
}

TEST_CASE("scene shapes: smooth normals weighted by angle") {
    const std::string corner = "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\n"
                               "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    const Mesh mesh = obj_of(corner, "<transform name=\"to_world\"><scale x=\"2\"/></transform>");
    REQUIRE(mesh.positions.size() == 4);
    // By position: Mitsuba numbers the vertices by first use, as is done here.
    const glm::dvec3 expected[4] = {
        {-0.5773502588272095, -0.5773502588272095, -0.5773502588272095},
        {-0.4280949831008911, 0.8863261342048645, -0.17652393877506256},
        {0.9926435351371765, -0.10759779065847397, -0.055512845516204834},
        {-0.5040373206138611, -0.42272019386291504, 0.753162682056427}};
    for (int i = 0; i < 4; ++i)
        CHECK(glm::length(mesh.normals[i] - expected[i]) < 1e-6);
}

TEST_CASE("scene shapes: normals transform by the inverse transpose") {
    const Mesh mesh = obj_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 1 1\nf 1//1 2//1 3//1\n",
                             "<transform name=\"to_world\"><scale x=\"2\"/></transform>");
    CHECK(glm::length(mesh.normals[0] - glm::dvec3(1, 2, 2) / 3.0) < 1e-15);
}

TEST_CASE("scene shapes: smooth normals at every scale") {
    for (const char* const scale : {"1e-100", "1e-30", "1e30", "1e100"}) {
        const Mesh mesh = obj_of(quad_without, "<transform name=\"to_world\"><scale value=\"" +
                                                   std::string(scale) + "\"/></transform>");
        CHECK(glm::length(mesh.normals[0] - glm::dvec3(0, 0, 1)) < 1e-15);
    }
}

TEST_CASE("scene shapes: where faces cancel out, a face's own normal stands, and a note says so") {
    const SceneFolder folder;
    folder.write("a.obj", "v 0.1 0.2 0.3\nv 1.7 0.1 0\nv 0.2 1.1 0\nf 1 2 3\nf 2 1 3\n");
    const Scene scene = load_scene(folder.write(
        "scene.xml", scene_text("<shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/>"
                                "</shape>")));
    const auto& mesh = std::get<Mesh>(scene.shapes[0].geometry);
    for (const glm::dvec3& n : mesh.normals)
        CHECK(std::abs(glm::dot(n, face_normal(mesh, 0))) == Approx(1.0));
    REQUIRE(scene.notes.size() == 1);
    CHECK_THAT(scene.notes[0], Contains("scene.xml:2") && Contains("3 vertices"));
}
