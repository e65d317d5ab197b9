// Lights that shine as textures tell: closed forms, and both ways to find them.
#include "tests/support/example_textures.h"
#include "tests/support/host_render.h"
#include "tests/support/sheet.h"
#include "tests/unit/test_scene_tools.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace parhelion;
using namespace parhelion::test;

namespace {

constexpr double one = 5.0, other = 1.0; // of four quarters two and two

Textured<Rgb> quarters() {
    return textured(Texture{"", glm::dmat3(1), CheckerboardTexture{Rgb(one), Rgb(other)}});
}

/// A white sheet and the light above it, which shines down.
Scene lit_by(const Geometry& light, const Textured<Rgb>& radiance) {
    Scene scene = sheet(0, no_material, {{"", {}, DiffuseBsdf{Rgb(1)}}});
    scene.shapes.push_back(shape_of(light, no_material, no_material, Rgb(1)));
    scene.shapes.back().radiance_texture = radiance.texture;
    scene.sampler.samples_per_pixel = 256;
    return scene;
}

Mesh lamp_above(double half, double height) {
    Mesh mesh = quad({-half, -half, height}, {0, 2 * half, 0}, {2 * half, 0, 0});
    mesh.uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    return mesh;
}

double seen(const Scene& scene) {
    return mean(host_render(scene, Precision::double_precision).image, "R");
}

/// Of a square of side 2 a at height h, from below its middle.
double form_factor(double a, double h) {
    double s = std::sqrt(a * a + h * h);
    return 4 / std::numbers::pi * (a / s) * std::atan(a / s);
}

} // namespace

TEST_CASE("Textured lights: their place and their values count, however they are found",
          "[textures]") {
    constexpr double half = 2, height = 6; // beyond the camera, which is below
    double expected = (one + other) / 2 * form_factor(half, height);
    Scene scene = lit_by(lamp_above(half, height), quarters());
    CHECK(make_device_scene(scene).lights.at(0).kind == emitter_area_parallelogram);
    CHECK(seen(scene) == Approx(expected).epsilon(0.01));
    scene.integrator.emitter_samples = false;
    CHECK(seen(scene) == Approx(expected).epsilon(0.05));
    scene.integrator.emitter_samples = true;
    scene.integrator.bsdf_samples = false;
    scene.integrator.kind = IntegratorKind::direct;
    CHECK(seen(scene) == Approx(expected).epsilon(0.01));
}

TEST_CASE("Textured lights: of every kind, sampled and met are the same", "[textures]") {
    Mesh pair = lamp_above(2, 6), one_triangle = pair;
    one_triangle.triangles.resize(1);
    const glm::dvec3 above(0.5, 0.3, 7);
    const Geometry lamps[] = {pair, one_triangle, Sphere{above, 1.5},
                              Disk{above, {1.5, 0.3, 0}, {0.2, -1.2, 0.1}},
                              Cylinder{above, {0, 2, 0}, {1, 0, 0}}};
    // Along axes that no symmetry of a lamp has.
    glm::dmat3 to_uv(2.3, 0.4, 0, -0.6, 1.7, 0, 0.13, 0.21, 1);
    Textured<Rgb> board = textured(Texture{"", to_uv, CheckerboardTexture{Rgb(one), Rgb(0)}});
    for (const Geometry& lamp : lamps) {
        CAPTURE(lamp.index());
        Scene scene = lit_by(lamp, board);
        scene.sampler.samples_per_pixel = 1024;
        scene.integrator.kind = IntegratorKind::direct;
        scene.integrator.emitter_samples = false;
        double met = seen(scene);
        scene.integrator.emitter_samples = true;
        scene.integrator.bsdf_samples = false;
        double sampled = seen(scene);
        CHECK(met > 0.02);
        CHECK(sampled == Approx(met).epsilon(0.04));
    }
}

TEST_CASE("Textured lights: files", "[textures]") {
    std::string board =
        R"(<texture type="checkerboard" name="radiance"><float name="color0" value="-1"/></texture>)";
    auto lamp = [](const std::string& radiance) {
        return "<shape type=\"rectangle\"><emitter type=\"area\">" + radiance +
               "</emitter></shape>";
    };
    using Catch::Matchers::Contains;
    Scene dark = load_body(lamp(board));
    CHECK_THROWS_WITH(make_device_scene(dark), Contains("\"radiance\" gets values from -1"));
    Scene scene = load_body(lamp(R"(<texture type="checkerboard" name="radiance"/>)"));
    DeviceScene flat = make_device_scene(scene);
    CHECK(flat.features.has(feature_textured_lights));
    CHECK(flat.texture_means.at(0) == Rgb(0.5 * (0.4 + 0.2)));
    // The same everywhere is no texture.
    Scene same = load_body(lamp(
        R"(<texture type="rawconstant" name="radiance"><float name="value" value="3"/></texture>)"));
    CHECK(*same.shapes.at(0).radiance == Rgb(3));
    CHECK(!make_device_scene(same).features.has(feature_textured_lights));
}
