// Shares of blends that textures tell: what files make of them, lists of lobes, and closed forms.
#include "host/flatten/lobe_lists.h"
#include "host/flatten/texture_records.h"
#include "tests/support/example_textures.h"
#include "tests/support/host_render.h"
#include "tests/support/sheet.h"
#include "tests/unit/test_scene_tools.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;

namespace {

constexpr double in_first = 0.7, in_second = 0.2; // as a number: 0.2 from (0, 0) on

/// Four quarters of the view of a sheet, two and two alike.
Textured<double> quarters() {
    return as_number(
        textured(Texture{"", glm::dmat3(1), CheckerboardTexture{Rgb(in_first), Rgb(in_second)}}));
}

const char* const board = R"(<texture type="checkerboard" name="NAME">
    <float name="color0" value="0.25"/><float name="color1" value="0.75"/></texture>)";
std::string named(const std::string& name, const std::string& texture = board) {
    std::string text = texture;
    return text.replace(text.find("NAME"), 4, name);
}
const std::string black = R"(<bsdf type="diffuse"><rgb name="reflectance" value="0,0,0"/></bsdf>)";
const std::string white = R"(<bsdf type="diffuse"><rgb name="reflectance" value="1,1,1"/></bsdf>)";

std::string shape(const std::string& bsdf) {
    return "<shape type=\"rectangle\">" + bsdf + "</shape>";
}
std::string masked(const std::string& opacity, const std::string& bsdf) {
    return "<bsdf type=\"mask\">" + opacity + bsdf + "</bsdf>";
}

double seen(const Scene& scene, const char* channel = "R") {
    return mean(host_render(scene, Precision::double_precision).image, channel);
}

} // namespace

TEST_CASE("Textured blends: shares are products of what textures leave and tell", "[blends]") {
    std::string inner = "<bsdf type=\"blendbsdf\">" + named("weight") + white + black + "</bsdf>";
    Scene scene = load_body(shape(masked(named("opacity"), inner)));
    REQUIRE(scene.blends.size() >= 2);
    CHECK(textures_of(scene).size() == 1);
    DeviceScene flat = make_device_scene(scene);
    CHECK(flat.features.has(feature_textured_blends));
    CHECK(flat.features.has(feature_textures));
    std::vector<LobeRecord> lobes = lobes_of(flat, flat.geometry.shapes.at(0).material_front);
    REQUIRE(lobes.size() == 3);
    int told = LOBE_FACTOR(0, false), rest = LOBE_FACTOR(0, true);
    CHECK(std::array{lobes[0].factor0, lobes[0].factor1} == std::array{rest, 0});
    CHECK(std::array{lobes[1].factor0, lobes[1].factor1} == std::array{told, rest});
    CHECK(std::array{lobes[2].factor0, lobes[2].factor1} == std::array{told, told});
    for (const LobeRecord& lobe : lobes)
        CHECK(lobe.weight == 1);
    // Nothing looks at materials there, and textures are not read.
    scene.integrator.kind = IntegratorKind::normals;
    CHECK(!make_device_scene(scene).features.has(feature_textured_blends));
}

TEST_CASE("Textured blends: refusals", "[blends]") {
    using Catch::Matchers::Contains;
    std::string bsdf = black;
    for (int k = 0; k < 4; k++)
        bsdf = masked(named("opacity"), bsdf);
    CHECK_NOTHROW(make_device_scene(load_body(shape(bsdf))));
    Scene five = load_body(shape(masked(named("opacity"), bsdf)));
    CHECK_THROWS_WITH(make_device_scene(five),
                      Contains("scene.xml:6: bsdf plugin \"mask\": parameter \"opacity\" is a "
                               "texture") &&
                          Contains("(accepted: textures for 4 one in the other)"));
    std::string wild = named("opacity", R"(<texture type="checkerboard" name="NAME">
        <float name="color0" value="1.5"/></texture>)");
    Scene beyond = load_body(shape(masked(wild, black)));
    CHECK_THROWS_WITH(make_device_scene(beyond),
                      Contains("\"opacity\" gets values from") && Contains("accepted: 0 to 1"));
}

TEST_CASE("Textured blends: of a sky is seen what a mask leaves", "[blends]") {
    constexpr double sky = 2, opacity = (in_first + in_second) / 2;
    Scene scene = sheet(0, 0, {{"", {}, NullBsdf{}}, {"", {}, DiffuseBsdf{Rgb(0)}}});
    scene.shapes[0].material_front = add_blend(scene, {quarters(), 0, 1});
    scene.emitters = {ConstantEmitter{Rgb(sky)}};
    CHECK(std::abs(seen(scene) - (1 - opacity) * sky) < 0.01);
    scene.integrator.hide_emitters = true;
    CHECK(std::abs(seen(scene, "A") - opacity) < 0.005);
    // The quarter at the left below, and that at its right.
    scene.film.crop_width = scene.film.crop_height = 4;
    scene.film.crop_y = 4;
    double left = seen(scene, "A");
    scene.film.crop_x = 4;
    CHECK(std::abs(left - in_second) < 0.005);
    CHECK(std::abs(seen(scene, "A") - in_first) < 0.005);
}

TEST_CASE("Textured blends: in a uniform sky the mean of the reflectances is seen", "[blends]") {
    Scene scene = sheet(0, no_material,
                        {{"", {}, DiffuseBsdf{Rgb(0.8)}},
                         {"", {}, DiffuseBsdf{Rgb(0.2)}},
                         {"", {}, ConductorBsdf{{Rgb(0), Rgb(1)}, Rgb(0.9)}}});
    int diffuse = add_blend(scene, {quarters(), 0, 1});
    scene.shapes[0].material_front = add_blend(scene, {quarters(), diffuse, 2});
    scene.emitters = {ConstantEmitter{Rgb(1)}};
    scene.integrator.aovs = {{"albedo", "albedo", {}}};
    double expected = 0;
    for (double w : {in_first, in_second})
        expected += 0.5 * ((1 - w) * ((1 - w) * 0.8 + w * 0.2) + w * 0.9);
    Image image = host_render(scene, Precision::double_precision).image;
    CHECK(std::abs(mean(image, "R") - expected) < 0.005);
    CHECK(mean(image, "albedo.R") == Approx(expected).epsilon(1e-6));
}

namespace {

/// A sheet, and a mask of opacity `opacity` between it and a point of light beside the view.
Scene behind_masks(int masks, const Textured<double>& opacity) {
    Scene scene = sheet(
        0, no_material,
        {{"", {}, DiffuseBsdf{Rgb(0.5)}}, {"", {}, NullBsdf{}}, {"", {}, DiffuseBsdf{Rgb(0)}}});
    scene.emitters = {PointEmitter{{4, 0, 4}, Rgb(10)}};
    int mask = add_blend(scene, {opacity, 1, 2});
    for (int k = 0; k < masks; k++) {
        Mesh mesh = quad({1 + 0.5 * k, -2, 0.2}, {0, 4, 0}, {0, 0, 4});
        for (const glm::dvec3& corner : mesh.positions)
            mesh.uvs.emplace_back((corner.y + 3) / 8, (corner.z + 2.2) / 8); // 1/8 to 6/8
        scene.shapes.push_back(shape_of(mesh, mask, mask));
    }
    scene.integrator.max_depth = -1;
    return scene;
}

} // namespace

TEST_CASE("Masks let the light of a point through by what they are not there", "[blends]") {
    double alone = seen(behind_masks(0, 0.3));
    REQUIRE(alone > 0.03);
    // No direction that is drawn meets the light: there is no noise.
    CHECK(seen(behind_masks(1, 0.3)) == Approx(0.7 * alone).epsilon(1e-5));
    CHECK(seen(behind_masks(3, 0.3)) == Approx(0.343 * alone).epsilon(1e-5));
    CHECK(seen(behind_masks(2, 0.0)) == Approx(alone).epsilon(1e-5)); // no surface at all
    CHECK(seen(behind_masks(1, 1.0)) == 0);
    // All of the light goes through where u and v are below 1/2.
    CHECK(seen(behind_masks(2, quarters())) ==
          Approx((1 - in_second) * (1 - in_second) * alone).epsilon(1e-5));
    // A path that counts every surface is as long.
    for (int masks : {0, 1, 2})
        for (int depth : {2, 3, 4}) {
            Scene scene = behind_masks(masks, 0.3);
            scene.integrator.max_depth = depth;
            double expected = masks + 2 <= depth ? std::pow(0.7, masks) * alone : 0;
            CHECK(seen(scene) == Approx(expected).epsilon(1e-5).margin(1e-9));
        }
}

TEST_CASE("What is opaque stands in the light beside masks, before and behind them", "[blends]") {
    double through = seen(behind_masks(2, 0.3));
    REQUIRE(through > 0.01);
    for (Precision precision : {Precision::single_precision, Precision::double_precision})
        for (double x : {0.8, 1.25, 1.8}) // the masks are at 1 and 1.5
            for (double y : {-2.0, 20.0}) {
                Scene scene = behind_masks(2, 0.3);
                scene.shapes.push_back(shape_of(quad({x, y, 0.2}, {0, 4, 0}, {0, 0, 4}), 2, 2));
                double found = mean(host_render(scene, precision).image, "R");
                CAPTURE(x, y);
                CHECK(found == Approx(y < 0 ? 0 : through).epsilon(1e-5));
            }
}

TEST_CASE("Masks let light through that is sampled and met by chance, once", "[blends]") {
    // Within a ball that reflects nothing and is there by half, the sheet sees half of the sky and
    // half of a lamp, whichever way either of them is found.
    for (bool lamp : {false, true}) {
        Scene scene = behind_masks(0, 0.5);
        scene.emitters = {ConstantEmitter{Rgb(1)}};
        if (lamp) {
            scene.emitters.clear();
            scene.shapes.push_back(
                shape_of(Sphere{{0, 0, 60}, 30}, no_material, no_material, Rgb(4)));
        }
        scene.sampler.samples_per_pixel = 256;
        double alone = seen(scene);
        int ball = add_blend(scene, {0.5, 1, 2});
        scene.shapes.push_back(shape_of(Sphere{{0, 0, 0}, 14}, ball, ball));
        CHECK(seen(scene) == Approx(0.5 * alone).epsilon(0.01));
        for (bool sampled : {false, true}) {
            Scene one = scene;
            one.shapes.back().material_front = one.shapes.back().material_back = 1; // nothing
            one.integrator.emitter_samples = sampled;
            CHECK(seen(one) == Approx(alone).epsilon(0.02));
        }
        // Of the half of the ball above, two quarters.
        scene.shapes.back().material_front = scene.shapes.back().material_back =
            add_blend(scene, {quarters(), 1, 2});
        double opacity = (in_first + in_second) / 2;
        if (!lamp) CHECK(seen(scene) == Approx((1 - opacity) * alone).epsilon(0.01));
    }
}
