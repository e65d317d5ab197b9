// Attributes of meshes: which of a PLY file's properties are which (held against what Mitsuba 3.9.1
// says of the same files), what cutting and dropping does to them, and what textures look up.
#include "host/numerics/every_kind_scene.h"
#include "host/scene/meshes/mesh_ply.h"
#include "test_scene_tools.h"
#include "tests/support/example_textures.h"
#include "tests/support/host_render.h"

#include <fmt/format.h>

#include <map>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;
using Catch::Contains;

namespace {

using Found = std::map<std::string, std::vector<float>>;

std::string properties(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text +=
            (name.find(' ') == std::string::npos ? "property float " : "property ") + name + "\n";
    return text;
}

/// A triangle, the properties of whose vertices are 0.125 more at the next vertex, and 0.25 more
/// from one to the next; of its face 0.25 more.
MeshData triangle(const std::vector<std::string>& vertex, const std::vector<std::string>& face) {
    std::string file = "ply\nformat ascii 1.0\nelement vertex 3\n" + properties({"x", "y", "z"}) +
                       properties(vertex) + "element face 1\n" +
                       "property list uchar int vertex_indices\n" + properties(face) +
                       "end_header\n";
    const char* const corners[] = {"0 0 0", "1 0 0", "0 1 0"};
    for (int k = 0; k < 3; k++) {
        file += corners[k];
        for (std::size_t n = 0; n < vertex.size(); n++)
            file += fmt::format(" {}", 0.125 * k + 0.25 * static_cast<double>(n));
        file += "\n";
    }
    file += "3 0 1 2";
    for (std::size_t n = 0; n < face.size(); n++)
        file += fmt::format(" {}", 0.25 * static_cast<double>(n));
    return parse_ply(file + "\n", false, "a.ply");
}

Found found(const MeshData& mesh) {
    Found all;
    for (const MeshAttribute& a : mesh.attributes) {
        CHECK(a.values.size() % static_cast<std::size_t>(a.channels) == 0);
        all[a.name] = a.values;
    }
    return all;
}

const std::vector<float> three{0, 0.25f, 0.5f, 0.125f, 0.375f, 0.625f, 0.25f, 0.5f, 0.75f};
const std::vector<float> one{0, 0.125f, 0.25f};

} // namespace

TEST_CASE("Mesh attributes: properties are grouped as in Mitsuba 3", "[textures]") {
    CHECK(found(triangle({"r", "g", "b"}, {})) == Found{{"vertex_color", three}});
    CHECK(found(triangle({"red", "green", "blue"}, {"r", "g", "b"})) ==
          Found{{"vertex_color", three}, {"face_color", {0, 0.25f, 0.5f}}});
    CHECK(found(triangle({"color_0", "color_1", "color_2"}, {"weight_0"})) ==
          Found{{"vertex_color", three}, {"face_weight", {0}}});
    CHECK(found(triangle({"foo_r", "foo_g", "foo_b"}, {})) == Found{{"vertex_foo_color", three}});
    CHECK(found(triangle({"a_b_0"}, {})) == Found{{"vertex_a_b", one}});
    CHECK(found(triangle({"foo_x", "foo_y"}, {})).empty());
    CHECK(found(triangle({"quality"}, {})).empty());
    CHECK(found(triangle({"color_1", "color_0"}, {})).empty());
    CHECK(found(triangle({"c_0", "c_1", "c_2", "c_3"}, {})).empty());
    // The first of two of one name.
    CHECK(found(triangle({"color_0", "w_0", "color_1", "color_2"}, {})) ==
          Found{{"vertex_color", one}, {"vertex_w", {0.25f, 0.375f, 0.5f}}});
    // What is none is noted.
    CHECK(triangle({"r", "g", "b"}, {"weight_0"}).notes.empty());
    CHECK_THAT(triangle({"quality"}, {}).notes.at(0),
               Contains("\"quality\" of the vertex element"));
}

TEST_CASE("Mesh attributes: cutting faces and dropping vertices keeps what is theirs",
          "[textures]") {
    // A square and a triangle; nothing uses vertex 1.
    MeshData mesh =
        parse_ply("ply\nformat ascii 1.0\nelement vertex 6\n" + properties({"x", "y", "z", "w_0"}) +
                      "element face 2\nproperty float n_0\n"
                      "property list uchar int vertex_indices\nend_header\n"
                      "0 0 0 0.5\n9 9 9 9\n1 0 0 1.5\n1 1 0 2.5\n0 1 0 3.5\n0 0 1 4.5\n"
                      "10 4 0 2 3 4\n20 3 0 2 5\n",
                  false, "a.ply");
    CHECK(mesh.triangles.size() == 3);
    CHECK(found(mesh) ==
          Found{{"vertex_w", {0.5f, 1.5f, 2.5f, 3.5f, 4.5f}}, {"face_n", {10, 10, 20}}});
    // Where a face crosses itself there is a vertex more, which lies between its ends.
    mesh =
        parse_ply("ply\nformat ascii 1.0\nelement vertex 4\n" + properties({"x", "y", "z", "w_0"}) +
                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                      "0 0 0 0\n1 0 0 1\n0 1 0 1\n1 1 0 2\n4 0 1 2 3\n",
                  false, "a.ply");
    REQUIRE(mesh.positions.size() == 5);
    CHECK(found(mesh).at("vertex_w").at(4) == Approx(1));
}

TEST_CASE("Mesh attributes: those that no texture names are not kept", "[textures]") {
    SceneFolder folder;
    folder.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n" +
                              properties({"x", "y", "z", "w_0", "r", "g", "b"}) +
                              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                              "0 0 0 0 .1 .2 .3\n1 0 0 1 .4 .5 .6\n0 1 0 1 .7 .8 .9\n3 0 1 2\n");
    auto scene_with = [&](const std::string& name) {
        return folder.write(
            "scene.xml",
            scene_text("<shape type='ply'><string name='filename' value='a.ply'/>"
                       "<bsdf type='diffuse'><texture type='mesh_attribute' name='reflectance'>"
                       "<string name='name' value='" +
                       name + "'/></texture></bsdf></shape>"));
    };
    Scene scene = load_scene(scene_with("vertex_color"));
    const Mesh& mesh = std::get<Mesh>(scene.shapes.at(0).geometry);
    REQUIRE(mesh.attributes.size() == 1);
    CHECK(mesh.attributes[0].name == "vertex_color");
    CHECK_FALSE(make_device_scene(scene).features.has(feature_vertex_uvs));
    // One that the mesh lacks; all that it has were dropped.
    CHECK_THROWS_WITH(
        make_device_scene(load_scene(scene_with("face_color"))),
        Contains("scene.xml:2: shape plugin \"ply\" has no attribute \"face_color\""));
    CHECK_THAT(
        refusal_of(scene_with("color")),
        Contains("\"name\" is \"color\" (accepted: a name that begins with vertex_ or face_)"));
}

TEST_CASE("Mesh attributes: faces have their own, vertices are interpolated", "[textures]") {
    // Two meshes and a sphere before them, so that primitives have other numbers than faces.
    auto scene_of = [](const char* name) {
        Scene scene;
        scene.file = "made by the test";
        Texture texture{"", glm::dmat3(1), MeshAttributeTexture{name, 0.5}};
        scene.materials = {{"", {}, DiffuseBsdf{textured(texture)}},
                           {"", {}, DiffuseBsdf{Rgb(0.5)}}};
        scene.shapes.push_back(shape_of(Sphere{{50, 0, 0}, 1}, 1, no_material));
        for (double x : {-2.0, 0.0}) {
            Mesh m = quad({x, -1, 0}, {2, 0, 0}, {0, 2, 0});
            auto shift = static_cast<float>(x + 2) / 8;
            m.attributes.push_back({"vertex_grey", 1, {shift, 0.5f + shift, 1, 0.25f}});
            m.attributes.push_back({"face_tint", 3, {shift, 0.5f, 0.25f, 0.75f, shift, 1}});
            scene.shapes.push_back(shape_of(m, 0, no_material));
        }
        scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                           glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 10, 1));
        scene.camera.fov_degrees = 1e-4;
        scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 1;
        scene.film.filter.kind = FilterKind::box;
        scene.integrator.kind = IntegratorKind::aov;
        scene.integrator.aovs = {{"a", "albedo", {}}};
        return scene;
    };
    auto seen = [](Scene scene, double x, double y) {
        scene.camera.to_world[3] = glm::dvec4(x, y, 10, 1);
        Image image = host_render(scene, Precision::single_precision).image;
        auto value = [&](const char* channel) {
            return double{find_channel(image, channel)->values[0]};
        };
        return Rgb(value("a.R"), value("a.G"), value("a.B"));
    };
    for (double left : {-2.0, 0.0}) {
        double shift = (left + 2) / 8;
        // Triangles 0 1 2 (lower right) and 0 2 3; p, q: from 0 to 1 across the square.
        for (auto [p, q] : {std::pair(0.75, 0.25), std::pair(0.25, 0.75), std::pair(0.5, 0.125)}) {
            CAPTURE(left, p, q);
            bool lower = p > q;
            double corner = shift, right = 0.5 + shift, far = 1, top = 0.25;
            double grey = lower ? corner + (right - corner) * p + (far - right) * q
                                : corner + (top - corner) * q + (far - top) * p;
            Rgb tint = lower ? Rgb(shift, 0.5, 0.25) : Rgb(0.75, shift, 1);
            Rgb vertices = seen(scene_of("vertex_grey"), left + 2 * p, 2 * q - 1);
            Rgb faces = seen(scene_of("face_tint"), left + 2 * p, 2 * q - 1);
            for (int c = 0; c < 3; c++) {
                CHECK(vertices[c] == Approx(0.5 * grey).margin(1e-5));
                CHECK(faces[c] == Approx(0.5 * tint[c]).margin(1e-6));
            }
        }
    }
}
