// What every mesh format accepts, leaves out with a note, and refuses: the same in all of them.
#include "test_mesh_tools.h"

#include "host/scene/meshes/mesh_obj.h"
#include "host/scene/meshes/mesh_ply.h"
#include "host/scene/meshes/mesh_serialized.h"

#include <glm/geometric.hpp>

#include <functional>
#include <limits>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The one list of formats: how a mesh is written and read, and whether faces have any number of
/// corners.
struct Format {
    std::string name;
    std::function<MeshData(const PlainMesh&)> read;
    bool polygons;
};

const std::vector<Format>& formats() {
    static const std::vector<Format> list = {
        {"obj", [](const PlainMesh& m) { return parse_obj(as_obj(m), false, "file"); }, true},
        {"ply text", [](const PlainMesh& m) { return parse_ply(as_ply_text(m), false, "file"); },
         true},
        {"ply little",
         [](const PlainMesh& m) { return parse_ply(as_ply_bytes(m, false), false, "file"); }, true},
        {"ply big",
         [](const PlainMesh& m) { return parse_ply(as_ply_bytes(m, true), false, "file"); }, true},
        {"serialized",
         [](const PlainMesh& m) { return parse_serialized(as_serialized(m), 0, "file").mesh; },
         false},
    };
    return list;
}

PlainMesh good_mesh() {
    return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}},
            {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {0, 0, 2}},
            {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
            {{0, 1, 2}, {0, 2, 3}}};
}

/// A corner of `good_mesh` spoilt in some way, and one more that no face uses.
PlainMesh with_unused_vertex(const glm::dvec3& position, const glm::dvec3& normal,
                             const glm::dvec2& uv) {
    PlainMesh mesh = good_mesh();
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uvs.push_back(uv);
    return mesh;
}

double area(const MeshData& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[t[0]];
        sum += glm::length(glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a)) / 2.0;
    }
    return sum;
}

} // namespace

TEST_CASE("scene mesh rules: a good mesh is read as it is, without a note") {
    for (const Format& format : formats()) {
        INFO(format.name);
        const MeshData mesh = format.read(good_mesh());
        CHECK(mesh.positions == good_mesh().positions);
        CHECK(mesh.normals == good_mesh().normals);
        CHECK(mesh.uvs == good_mesh().uvs);
        CHECK(mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}});
        CHECK(mesh.notes.empty());
    }
}

TEST_CASE("scene mesh rules: what no face uses may hold anything") {
    for (const Format& format : formats())
        for (const double bad : {nan_value, infinity, -infinity, 1e308}) {
            INFO(format.name << ", " << bad);
            const MeshData mesh =
                format.read(with_unused_vertex({bad, 0, bad}, {0, bad, 0}, {bad, bad}));
            CHECK(mesh.positions == good_mesh().positions);
            CHECK(mesh.normals == good_mesh().normals);
            CHECK(mesh.uvs == good_mesh().uvs);
            CHECK(mesh.notes.empty());
        }
}

TEST_CASE("scene mesh rules: a used position that is not finite is refused") {
    for (const Format& format : formats())
        for (const double bad : {nan_value, infinity, -infinity})
            for (std::size_t corner = 0; corner < 4; ++corner) {
                INFO(format.name << ", " << bad << ", " << corner);
                PlainMesh mesh = good_mesh();
                mesh.positions[corner].y = bad;
                CHECK_THAT(refusal([&] { format.read(mesh); }),
                           Contains("file") && Contains("vertex") && Contains("not finite"));
            }
}

TEST_CASE("scene mesh rules: normals and texture coordinates that are none are left out, counted") {
    for (const Format& format : formats()) {
        INFO(format.name);
        PlainMesh mesh = good_mesh();
        mesh.normals[1] = glm::dvec3(0.0);
        mesh.normals[2].x = nan_value;
        mesh.uvs[3].x = infinity;
        const MeshData read = format.read(mesh);
        CHECK(read.normals == std::vector<glm::dvec3>{{0, 0, 1}, {0, 0, 0}, {0, 0, 0}, {0, 0, 2}});
        CHECK(read.uvs == std::vector<glm::dvec2>{{0, 0}, {1, 0}, {1, 1}, {0, 0}});
        REQUIRE(read.notes.size() == 2);
        CHECK_THAT(read.notes[0], Contains("file: 2 vertex normals are zero or not finite"));
        CHECK_THAT(read.notes[1], Contains("file: 1 texture coordinate is not finite"));
        for (glm::dvec3& n : mesh.normals)
            n = glm::dvec3(0.0);
        CHECK(format.read(mesh).normals.empty());
        std::vector<std::string> notes;
        const Mesh made = make_mesh(format.read(mesh), {}, {"s.xml", 1}, notes);
        CHECK(made.normals[0] != glm::dvec3(0.0)); // computed
    }
}

TEST_CASE("scene mesh rules: faces of no area are counted, and stay") {
    for (const Format& format : formats()) {
        INFO(format.name);
        PlainMesh mesh = good_mesh();
        mesh.faces.push_back({1, 1, 2});
        const MeshData read = format.read(mesh);
        CHECK(read.triangles.size() == 3);
        REQUIRE(read.notes.size() == 1);
        CHECK_THAT(read.notes[0], Contains("1 face has no area"));
    }
}

TEST_CASE("scene mesh rules: a mesh without faces is empty") {
    for (const Format& format : formats()) {
        INFO(format.name);
        PlainMesh mesh = good_mesh();
        mesh.faces.clear();
        const MeshData read = format.read(mesh);
        CHECK(read.positions.empty());
        CHECK(read.triangles.empty());
        CHECK(read.normals.empty());
        CHECK(format.read({}).triangles.empty());
    }
}

TEST_CASE("scene mesh rules: faces of fewer than three corners are left out, counted") {
    for (const Format& format : formats()) {
        if (!format.polygons) continue;
        INFO(format.name);
        PlainMesh mesh = with_unused_vertex(glm::dvec3(nan_value), glm::dvec3(0.0), {});
        mesh.faces.insert(mesh.faces.begin(), {{0, 4}, {4}, {}});
        const MeshData read = format.read(mesh);
        CHECK(read.positions == good_mesh().positions);
        CHECK(read.triangles.size() == 2);
        REQUIRE(read.notes.size() == 1);
        CHECK_THAT(read.notes[0], Contains("3 faces have fewer than three corners"));
    }
}

TEST_CASE("scene mesh rules: concave faces have the area of their outline") {
    for (const Format& format : formats()) {
        if (!format.polygons) continue;
        INFO(format.name);
        const PlainMesh arrow{
            {{0, 1.5, 0}, {-1, -1, 0}, {0, 0, 0}, {1, -1, 0}}, {}, {}, {{1, 2, 3, 0}}};
        CHECK(area(format.read(arrow)) == Approx(1.5));
        PlainMesh star;
        star.faces.emplace_back();
        double outlined = 0.0;
        for (std::uint32_t i = 0; i < 300; ++i) {
            const double angle = i * 0.02094395102393195, r = i % 2 ? 1.0 : 0.5;
            star.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
            star.normals.emplace_back(0, 0, 1);
            star.uvs.emplace_back(r, angle);
            star.faces[0].push_back(i);
            outlined += 0.25 * std::sin(0.02094395102393195);
        }
        const MeshData read = format.read(star);
        CHECK(read.triangles.size() == 298);
        CHECK(area(read) == Approx(outlined).epsilon(1e-12));
        CHECK(read.uvs == star.uvs);
    }
}

TEST_CASE("scene mesh rules: where edges cross there is a vertex with the mean of its ends") {
    for (const Format& format : formats()) {
        if (!format.polygons) continue;
        INFO(format.name);
        const PlainMesh bow{{{0, 0, 1}, {2, 2, 1}, {2, 0, 1}, {0, 2, 1}},
                            {{1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}},
                            {{0, 0}, {1, 1}, {1, 0}, {0, 1}},
                            {{0, 1, 2, 3}}};
        const MeshData read = format.read(bow);
        REQUIRE(read.positions.size() == 5);
        CHECK(glm::length(read.positions[4] - glm::dvec3(1, 1, 1)) < 1e-15);
        CHECK(glm::length(read.normals[4] - glm::dvec3(0, 0, 1)) < 1e-15);
        CHECK(glm::length(read.uvs[4] - glm::dvec2(0.5, 0.5)) < 1e-15);
        CHECK(area(read) == Approx(2.0));
    }
}

namespace {

std::string utf16(const std::string& text, bool big, bool mark) {
    std::string result = !mark ? "" : big ? "\xfe\xff" : "\xff\xfe";
    for (const char c : text)
        result += big ? std::string{'\0', c} : std::string{c, '\0'};
    return result;
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
    for (std::size_t i = 0; (i = text.find(part, i)) != std::string::npos; i += by.size())
        text.replace(i, part.size(), by);
    return text;
}

} // namespace

TEST_CASE("scene mesh rules: encodings of text and ends of lines") {
    const std::pair<std::string, std::function<std::string(std::string)>> writers[] = {
        {"mark", [](const std::string& t) { return "\xef\xbb\xbf" + t; }},
        {"CR LF", [](const std::string& t) { return replaced(t, "\n", "\r\n"); }},
        {"CR", [](const std::string& t) { return replaced(t, "\n", "\r"); }},
        {"mark, CR", [](const std::string& t) { return "\xef\xbb\xbf" + replaced(t, "\n", "\r"); }},
        {"UTF-16 little", [](const std::string& t) { return utf16(t, false, true); }},
        {"UTF-16 big", [](const std::string& t) { return utf16(t, true, true); }},
        {"UTF-16 little, no mark", [](const std::string& t) { return utf16(t, false, false); }},
        {"UTF-16 big, no mark", [](const std::string& t) { return utf16(t, true, false); }},
    };
    for (const auto& [name, write] : writers) {
        INFO(name);
        for (const MeshData& mesh : {parse_obj(write(as_obj(good_mesh())), false, "file"),
                                     parse_ply(write(as_ply_text(good_mesh())), false, "file")}) {
            CHECK(mesh.positions == good_mesh().positions);
            CHECK(mesh.triangles.size() == 2);
            CHECK(mesh.notes.empty());
        }
    }
    const std::string utf32("\xff\xfe\0\0v\0\0\0", 8);
    CHECK_THAT(refusal([&] { parse_obj(utf32, false, "file"); }), Contains("UTF-32"));
}

TEST_CASE("scene mesh rules: memory is known from the file before it is spent") {
    const std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
        "property char x\nproperty char y\nproperty char z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    CHECK_THAT(refusal([&] { parse_ply(header + std::string(3000, '\0'), false, "file"); }),
               Contains("4000000000") && Contains("more than the file can hold"));
    // Zeros deflate a thousandfold: 3 million vertices in 35 kB.
    std::string content;
    put(content, 0x1000u);
    put(content, std::uint64_t(3000000));
    put(content, std::uint64_t(1));
    content.resize(content.size() + 3000000 * 12 + 12, '\0');
    CHECK_THAT(refusal([&] { parse_serialized(serialized_content(content, 3), 0, "file"); }),
               Contains("3000000 vertices") && Contains("64 times"));
    // Vertices that no face uses take no memory once the file is read.
    PlainMesh mesh = good_mesh();
    mesh.positions.resize(100000, glm::dvec3(7.0));
    mesh.normals.resize(100000, glm::dvec3(1.0));
    mesh.uvs.resize(100000);
    for (const Format& format : formats()) {
        INFO(format.name);
        const MeshData read = format.read(mesh);
        CHECK(read.positions.capacity() < 100);
        CHECK(read.normals.capacity() < 100);
        CHECK(read.uvs.capacity() < 100);
    }
}
