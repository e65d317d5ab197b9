// Mesh files: OBJ, PLY and Mitsuba's serialized format, good ones and damaged ones.
#include "test_mesh_tools.h"

#include "host/scene/meshes/mesh_obj.h"
#include "host/scene/meshes/mesh_ply.h"
#include "host/scene/meshes/mesh_serialized.h"

#include <glm/geometric.hpp>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

const SourceLocation asker{"scene.xml", 3};

MeshData obj(const std::string& text, bool flip_v = true) {
    const SceneFolder folder;
    return load_obj(folder.write("a.obj", text), flip_v, asker);
}

MeshData ply(const std::string& text, bool flip_v = false) {
    const SceneFolder folder;
    return load_ply(folder.write("a.ply", text), flip_v, asker);
}

constexpr const char* ply_text = "ply\nformat ascii 1.0\ncomment made here\nelement vertex 4\n"
                                 "property double x\nproperty float y\nproperty float32 z\n"
                                 "property uchar red\nproperty float s\nproperty float t\n"
                                 "element face 1\nproperty list uchar int vertex_indices\n"
                                 "end_header\n"
                                 "0.1 0 0 255 0 0\n1 0 0 0 1 0\n1 1 0 0 1 1\n0 1 0 0 0 0.25\n"
                                 "4 0 1 2 3\n";

std::string binary_ply(bool big) {
    std::string bytes = std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\r\nelement vertex 3\r\nproperty double x\r\n"
                        "property float y\r\nproperty short z\r\nproperty float nx\r\n"
                        "property float ny\r\nproperty float nz\r\nelement face 1\r\n"
                        "property uchar kind\r\nproperty list ushort uint vertex_index\r\n"
                        "end_header\r\n";
    for (int i = 0; i < 3; ++i) {
        put(bytes, 0.1 + i, big);
        put(bytes, 0.5f * static_cast<float>(i * i), big);
        put(bytes, static_cast<std::int16_t>(-i), big);
        for (const float n : {0.0f, 0.0f, 2.0f})
            put(bytes, n, big);
    }
    put(bytes, std::uint8_t(7), big);
    put(bytes, std::uint16_t(3), big);
    for (const std::uint32_t i : {0u, 1u, 2u})
        put(bytes, i, big);
    return bytes;
}

/// One mesh of a serialized file: magic, version and the deflated rest.
template<typename Real>
std::string serialized_mesh(std::uint32_t flags, std::uint16_t version, Real x,
                            std::uint32_t last_index = 2, std::uint64_t vertices = 3,
                            bool says_precision = true) {
    std::string content;
    put(content, flags | (!says_precision ? 0u : sizeof(Real) == 8 ? 0x2000u : 0x1000u));
    if (version == 4) content += std::string("name\0", 5);
    put(content, vertices);
    put(content, std::uint64_t(1));
    for (const Real v : {x, Real(0), Real(0), Real(1), Real(0), Real(0), Real(0), Real(1), Real(0)})
        put(content, v);
    if (flags & 1)
        for (int i = 0; i < 9; ++i)
            put(content, Real(i % 3 == 2 ? 1 : 0));
    if (flags & 2)
        for (int i = 0; i < 6; ++i)
            put(content, Real(i) / 8);
    if (flags & 8)
        for (int i = 0; i < 9; ++i)
            put(content, Real(1));
    for (const std::uint32_t i : {0u, 1u, last_index})
        put(content, i);
    return serialized_content(content, version);
}

std::string serialized_file(const std::vector<std::string>& meshes, std::uint16_t version) {
    std::string file, table;
    for (const std::string& mesh : meshes) {
        if (version == 4)
            put(table, std::uint64_t(file.size()));
        else
            put(table, std::uint32_t(file.size()));
        file += mesh;
    }
    put(table, std::uint32_t(meshes.size()));
    return file + table;
}

SerializedMesh serialized(const std::string& bytes, std::int64_t index = 0) {
    const SceneFolder folder;
    return load_serialized(folder.write("a.serialized", bytes), index, asker);
}

} // namespace

TEST_CASE("scene meshes: OBJ corners share vertices by position, texture and normal") {
    const MeshData mesh = obj("# a comment\no thing\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 0 1\n"
                              "vt 0 0\nvt 1 0\nvt 1 0.25\nf 1/1 2/2 3/3\nf 1/3 4/1 2/2\n");
    CHECK(mesh.positions.size() == 5); // vertex 1 twice: two texture vertices
    CHECK(mesh.triangles.size() == 2);
    CHECK(mesh.triangles[1][2] == mesh.triangles[0][1]);
    CHECK(mesh.uvs[mesh.triangles[0][2]] == glm::dvec2(1.0, 0.75));
    CHECK(mesh.normals.empty());
    CHECK(obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 1 0.25\nf 1/1 2/1 3/1\n", false).uvs[0] ==
          glm::dvec2(1.0, 0.25));
}

TEST_CASE("scene meshes: OBJ polygons, counted from the front or the back") {
    const std::string points = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n";
    const MeshData mesh = obj(points + "f 2 3 4 1\n"); // a fan around the first corner
    REQUIRE(mesh.triangles.size() == 2);
    CHECK(mesh.triangles[0] == glm::uvec3(0, 1, 2));
    CHECK(mesh.triangles[1] == glm::uvec3(0, 2, 3));
    CHECK(mesh.positions[0] == glm::dvec3(4, 0, 0));
    CHECK(obj(points + "f -3 -2 -1 -4\n").positions == mesh.positions);
    CHECK(mesh.uvs.empty());
}

TEST_CASE("scene meshes: OBJ numbers in double precision and every usual form") {
    const MeshData mesh = obj("v 0.1 -.5 +2.\nv 1E2 1e-3 123456789.125\nv 1e+05 0 -0\nf 1 2 3\n");
    CHECK(mesh.positions[0].x == Approx(0.1).epsilon(1e-15));
    CHECK(mesh.positions[0].y == -0.5);
    CHECK(mesh.positions[0].z == 2.0);
    CHECK(mesh.positions[1].x == 100.0);
    CHECK(mesh.positions[1].y == Approx(1e-3).epsilon(1e-15));
    CHECK(mesh.positions[1].z == Approx(123456789.125).epsilon(1e-15));
    CHECK(mesh.positions[2].x == 100000.0);
}

TEST_CASE("scene meshes: OBJ corners without normal get computed ones") {
    const SceneFolder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 1 1\n"
                          "f 1//1 2//1 3//1\nf 1 3 4\n");
    const Scene scene = load_scene(folder.write(
        "scene.xml", scene_text("<shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/>"
                                "</shape>")));
    const auto& mesh = std::get<Mesh>(scene.shapes[0].geometry);
    CHECK(mesh.normals[mesh.triangles[0][0]].y == Approx(std::sqrt(0.5)));
    CHECK(mesh.normals[mesh.triangles[1][0]] == glm::dvec3(0, 0, 1));
}

TEST_CASE("scene meshes: OBJ lines that cannot be read") {
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::pair<std::string, std::string> cases[] = {
        {points + "f 1 2 4\n", "a.obj:4: a face uses vertex 4 of 3"},
        {points + "f 1 2 0\n", "a.obj:4: \"0\""},
        {points + "f 1 2 -4\n", "a.obj:4: \"-4\" counts back"},
        {points + "f 1 2 x\n", "a.obj:4: \"x\""},
        {points + "f /1 /1 /1\n", "a.obj:4: \"/1\""},
        {points + "f 1/1/1/1 2 3\n", "a.obj:4: \"1/1/1/1\""},
        {points + "vn 0 0 1\nf 1//2 2//1 3//1\n", "a.obj:5: a face uses normal 2 of 1"},
        {points + "vt 0\nf 1/2 2/2 3/2\n", "a.obj:5: a face uses texture vertex 2 of 1"},
        {points + "vt 0\nf 1/-2 2/1 3/1\n", "a.obj:5: \"-2\" counts back"},
        {points + "f 1 2 99999999999\n", "a.obj:4: a face uses vertex 99999999999 of 3"},
        {points + "f 1 2 99999999999999999999\n", "a.obj:4: \"99999999999999999999\""},
        {"v 0 0\n", "a.obj:1"},
        {"v 0 0 0,5\n", "a.obj:1: \"0,5\""},
        {"\nvn 0 a 1\n", "a.obj:2: \"a\""},
        {"vt x\n", "a.obj:1: \"x\""},
    };
    for (const auto& [text, part] : cases) {
        INFO(text.substr(0, 100));
        const std::string message = refusal([&text = text] { obj(text); });
        CHECK_THAT(message, Contains(part));
        CHECK(message.find('\n') == std::string::npos);
    }
}

TEST_CASE("scene meshes: an empty mesh is noted among others, refused alone") {
    const SceneFolder folder;
    folder.write("a.obj", "v 0 0 0\np 1\n");
    const std::string shape = "<shape type=\"obj\"><string name=\"filename\" value=\"a.obj\"/>"
                              "<emitter type=\"area\"/></shape>";
    CHECK_THAT(refusal_of(folder.write("scene.xml", scene_text(shape + shape))),
               Contains("scene.xml:2") && Contains("no triangle") && Contains("points"));
    const Scene scene =
        load_scene(folder.write("scene.xml", scene_text(shape + "<shape type=\"sphere\"/>")));
    CHECK(scene.shapes.size() == 2);
    REQUIRE(scene.notes.size() == 2);
    CHECK_THAT(scene.notes[1], Contains("scene.xml:2") && Contains("no triangle"));
}

TEST_CASE("scene meshes: PLY as text") {
    const MeshData mesh = ply(ply_text);
    REQUIRE(mesh.positions.size() == 4);
    CHECK(mesh.positions[0] == glm::dvec3(0.1, 0, 0));
    CHECK(mesh.uvs[3] == glm::dvec2(0, 0.25));
    CHECK(ply(ply_text, true).uvs[3] == glm::dvec2(0, 0.75));
    REQUIRE(mesh.triangles.size() == 2);
    CHECK(mesh.triangles[1] == glm::uvec3(0, 2, 3));
    CHECK(mesh.normals.empty());
    REQUIRE(mesh.notes.size() == 1);
    CHECK_THAT(mesh.notes[0], Contains("\"red\""));
    CHECK(ply(std::string(ply_text) + " \n").notes.size() == 1);
    CHECK_THAT(ply(std::string(ply_text) + "4 0 1 2 3\n").notes.back(), Contains("after the last"));
}

TEST_CASE("scene meshes: PLY as bytes of either order") {
    for (const bool big : {false, true}) {
        const MeshData mesh = ply(binary_ply(big));
        REQUIRE(mesh.positions.size() == 3);
        CHECK(mesh.positions[2] == glm::dvec3(2.1, 2.0, -2.0));
        CHECK(mesh.normals[1] == glm::dvec3(0, 0, 2));
        REQUIRE(mesh.triangles.size() == 1);
        CHECK(mesh.triangles[0] == glm::uvec3(0, 1, 2));
    }
}

TEST_CASE("scene meshes: PLY cut short at any byte, or with any byte changed, is no crash") {
    for (const std::string& good : {std::string(ply_text), binary_ply(false)}) {
        for (std::size_t size = 0; size + 2 < good.size(); ++size)
            CHECK_FALSE(refusal([&] { ply(good.substr(0, size)); }).empty());
        for (std::size_t i = 0; i < good.size(); ++i)
            for (const char c : {'\0', '\xff', '9', 'z', '\n'}) {
                std::string changed = good;
                changed[i] = c;
                const std::string message = refusal([&] { ply(changed); });
                CHECK(message.find('\n') == std::string::npos);
            }
    }
}

TEST_CASE("scene meshes: PLY files that cannot be read") {
    const auto file = [](const std::string& header, const std::string& data) {
        return "ply\nformat ascii 1.0\n" + header + "end_header\n" + data;
    };
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    const std::string corners = "property list uchar int vertex_indices\n";
    const std::string tri = "element vertex 3\n" + xyz + "element face 1\n" + corners;
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
    const std::pair<std::string, std::string> cases[] = {
        {"", "a.ply"},
        {"plx\n", "a.ply:1"},
        {"ply\nformat ascii 2.0\n", "a.ply:2"},
        {"ply\nformat ascii 1.0\nelement vertex x\n", "a.ply:3"},
        {"ply\nformat ascii 1.0\nelement vertex -1\n", "a.ply:3"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", "a.ply:4: unknown PLY type"},
        {"ply\nformat ascii 1.0\nproperty float x\n", "a.ply:3"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int a\n", "a.ply:4"},
        {"ply\nend_header\n", "a.ply:2"},
        {file(tri, points + "3 0 1 3\n"), "a.ply:13: a face uses vertex 3"},
        {file(tri, points + "3 0 1 -1\n"), "a.ply:13"},
        {file(tri, points + "3 0 1 1.5\n"), "a.ply:13"},
        {file(tri, points + "-1 0 1\n"), "a list claims"},
        {file(tri, points + "200 0 1 2\n"), "a list claims"},
        {file(tri, points), "ends too early"},
        {file(tri, "0 0 0\n1 0 x\n"), "a.ply:11: \"x\""},
        {file(tri, "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"), "a.ply:13: a face uses vertex 0"},
        {file("element face 1\n" + corners, "3 0 1 2"), "\"vertex\" and then one \"face\""},
        {file("element vertex 9999999999\n" + xyz + "element face 1\n" + corners, points),
         "9999999999"},
        {file("element vertex 3\nproperty float x\nproperty float y\n", points), "lack"},
        {file("element vertex 3\n" + xyz + "property float x\n", points), "twice"},
        {file("element vertex 3\n" + xyz + "element face 1\nproperty int a\n", points),
         "vertex_indices"},
    };
    for (const auto& [text, part] : cases) {
        INFO(text);
        CHECK_THAT(refusal([&text = text] { ply(text); }), Contains(part));
    }
}

TEST_CASE("scene meshes: serialized") {
    for (const std::uint16_t version : {std::uint16_t(3), std::uint16_t(4)}) {
        const std::string file = serialized_file(
            {serialized_mesh(1 | 2 | 8, version, 0.1), serialized_mesh(0x10, version, 0.5f)},
            version);
        const SerializedMesh first = serialized(file), second = serialized(file, 1);
        CHECK(first.mesh.positions[0].x == 0.1);
        CHECK(first.mesh.normals[2] == glm::dvec3(0, 0, 1));
        CHECK(first.mesh.uvs[1] == glm::dvec2(0.25, 0.375));
        CHECK(first.mesh.triangles[0] == glm::uvec3(0, 1, 2));
        CHECK_FALSE(first.face_normals);
        CHECK(first.mesh.notes.size() == 1); // the colours
        CHECK(second.mesh.positions[0].x == 0.5);
        CHECK(second.mesh.normals.empty());
        CHECK(second.face_normals);
        CHECK_THAT(refusal([&] { serialized(file, 2); }), Contains("shape_index 2"));
    }
}

// As in Mitsuba 3.9.1.
TEST_CASE("scene meshes: a serialized file that names no precision is single") {
    const SerializedMesh mesh =
        serialized(serialized_file({serialized_mesh(1, 3, 0.25f, 2, 3, false)}, 3));
    CHECK(mesh.mesh.positions[0] == glm::dvec3(0.25, 0, 0));
    CHECK(mesh.mesh.normals[2] == glm::dvec3(0, 0, 1));
    CHECK_THAT(refusal([&] { serialized(serialized_mesh(0x1000, 4, 0.1)); }),
               Contains("both single and double"));
}

TEST_CASE("scene meshes: damaged serialized files") {
    const std::string good = serialized_file({serialized_mesh(1, 4, 0.1)}, 4);
    std::string magic = good, version = good;
    magic[0] = 'x';
    version[2] = 9;
    CHECK_THAT(refusal([&] { serialized(magic); }), Contains("a.serialized"));
    CHECK_THAT(refusal([&] { serialized(version); }), Contains("version 9"));
    CHECK_THAT(refusal([&] { serialized(serialized_mesh(0, 4, 0.1, 3)); }), Contains("vertex 3"));
    CHECK_THAT(refusal([&] { serialized(serialized_mesh(0, 4, 0.1, 2, std::uint64_t(1) << 40)); }),
               Contains("1099511627776 vertices"));
    CHECK_THAT(refusal([&] { serialized(serialized_mesh(0, 4, 0.1, 2, 1000)); }),
               Contains("ends too early"));
    CHECK_THAT(refusal([&] {
                   serialized(serialized_mesh(0, 4, std::numeric_limits<double>::quiet_NaN()));
               }),
               Contains("not finite"));
    const std::size_t packed_end = good.size() - 12;
    for (std::size_t size = 0; size < packed_end - 5; ++size)
        CHECK_FALSE(refusal([&] { serialized(good.substr(0, size)); }).empty());
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string changed = good;
        changed[i] = static_cast<char>(changed[i] ^ 0x5a);
        for (const std::int64_t index : {0, 1})
            CHECK(refusal([&] { serialized(changed, index); }).find('\n') == std::string::npos);
    }
}
