// Surfaces that are several materials at once: what files make of them, their lists of lobes, and
// what light does there, against closed forms.
#include "host/flatten/lobe_lists.h"
#include "host/twin/sample_trace.h"
#include "tests/support/host_render.h"
#include "tests/support/sheet.h"
#include "tests/support/two_of_every.h"
#include "tests/unit/test_scene_tools.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <map>

using namespace parhelion;
using namespace parhelion::test;

namespace {

const std::string red =
    R"(<bsdf type="diffuse" id="red"><rgb name="reflectance" value="0.8,0,0"/></bsdf>)";
const std::string green =
    R"(<bsdf type="diffuse"><rgb name="reflectance" value="0,0.8,0"/></bsdf>)";

std::string shape(const std::string& bsdf) {
    return "<shape type=\"rectangle\">" + bsdf + "</shape>";
}
std::string mask(const std::string& opacity, const std::string& bsdf) {
    return "<bsdf type=\"mask\">" + opacity + bsdf + "</bsdf>";
}
std::string blend(const std::string& weight, const std::string& bsdfs) {
    return "<bsdf type=\"blendbsdf\">" + weight + bsdfs + "</bsdf>";
}
std::string number(const std::string& name, const std::string& value) {
    return "<float name=\"" + name + "\" value=\"" + value + "\"/>";
}

/// The share of each material of a side of the first shape, by its number.
std::map<int, double> shares(const DeviceScene& flat, bool back) {
    const ShapeRecord& s = flat.geometry.shapes.at(0);
    std::map<int, double> result;
    double below = 0;
    auto lobes = lobes_of(flat, back ? s.material_back : s.material_front);
    for (std::size_t i = 0; i < lobes.size(); i++) {
        CHECK(lobes[i].below == Approx(below));
        CHECK(lobes[i].behind == static_cast<int>(lobes.size() - 1 - i));
        CHECK(result.emplace(lobes[i].material, lobes[i].weight).second);
        below += lobes[i].weight;
    }
    if (!lobes.empty()) CHECK(below == Approx(1));
    return result;
}

/// Each material of the scene, by a blend of it and of a copy of it.
void blend_with_copies(Scene& scene) {
    std::vector<Material> copies = scene.materials;
    auto count = static_cast<int>(copies.size());
    scene.materials.insert(scene.materials.end(), copies.begin(), copies.end());
    for (Shape& s : scene.shapes)
        for (int* side : {&s.material_front, &s.material_back})
            if (*side >= 0) *side = add_blend(scene, {0.3, *side, *side + count});
}

} // namespace

TEST_CASE("Blends: a mask shares with nothing at all, on both sides", "[blends]") {
    Scene scene = load_body(shape(mask(number("opacity", "0.25"), red)));
    REQUIRE(scene.materials.size() == 3); // what is seen, what is let through, what absorbs
    CHECK(scene.materials[0].id == "red");
    CHECK(std::holds_alternative<NullBsdf>(scene.materials[1].bsdf));
    CHECK(std::get<DiffuseBsdf>(scene.materials[2].bsdf).reflectance == Rgb(0));
    DeviceScene flat = make_device_scene(scene);
    CHECK(shares(flat, false) == std::map<int, double>{{0, 0.25}, {1, 0.75}});
    CHECK(shares(flat, true) == std::map<int, double>{{1, 0.75}, {2, 0.25}});
    CHECK(flat.features.has(feature_blends));
    CHECK(flat.features.has(feature_straight_through));
    // From below it does what its front does by itself.
    CHECK(!flat.features.has(feature_back_materials));
    std::string both = "<bsdf type=\"twosided\">" + red + "</bsdf>";
    DeviceScene two = make_device_scene(load_body(shape(mask(number("opacity", "0.25"), both))));
    CHECK(two.features.has(feature_back_materials));
    CHECK(shares(two, true) == shares(two, false));
}

TEST_CASE("Blends: a tree is a list of its materials, each with what it is weighted by",
          "[blends]") {
    std::string inner = blend(number("weight", "0.5"), red + green);
    std::string named = R"(<bsdf type="conductor" id="metal"/>)";
    Scene scene = load_body(
        named + shape(blend(number("weight", "0.25"),
                            "<ref id=\"metal\"/>" + mask(number("opacity", "0.5"), inner))));
    DeviceScene flat = make_device_scene(scene);
    std::map<std::string, double> by_name;
    for (auto [material, share] : shares(flat, false))
        by_name[scene.materials[static_cast<std::size_t>(material)].id] = share;
    CHECK(by_name == std::map<std::string, double>{{"metal", 0.75},
                                                   {"red", 0.0625},
                                                   {"bsdf 3", 0.0625},
                                                   {"what masks let through", 0.125}});
    // The same twice is once.
    std::string twice = "<ref id=\"r\"/>";
    Scene same = load_body(R"(<bsdf type="diffuse" id="r"/>)" +
                           shape(blend(number("weight", "0.5"), twice + twice)));
    CHECK(make_device_scene(same).geometry.shapes[0].material_front >= -2);
}

TEST_CASE("Blends: what has no share is not there", "[blends]") {
    auto shown = [](const std::string& bsdf) {
        Scene scene = load_body(shape(bsdf));
        int front = scene.shapes[0].material_front;
        REQUIRE(front >= 0);
        CHECK(scene.blends.empty());
        return scene.materials[static_cast<std::size_t>(front)].bsdf;
    };
    CHECK(shown(mask(number("opacity", "1"), red)).index() == material_diffuse);
    CHECK(shown(mask(number("opacity", "0"), red)).index() == material_null);
    Bsdf first = shown(blend(number("weight", "0"), red + green));
    CHECK(std::get<DiffuseBsdf>(first).reflectance.constant.r == 0.8);
    Bsdf second = shown(blend(number("weight", "1"), red + green));
    CHECK(std::get<DiffuseBsdf>(second).reflectance.constant.g == 0.8);
}

TEST_CASE("Blends: a share given as a colour is the mean of its channels", "[blends]") {
    // Mitsuba 3.9.1 (scalar_rgb) shows the same as of 0.5.
    std::string colour = R"(<rgb name="opacity" value="0.2,0.5,0.8"/>)";
    DeviceScene flat = make_device_scene(load_body(shape(mask(colour, red))));
    CHECK(shares(flat, false) == std::map<int, double>{{0, 0.5}, {1, 0.5}});
    DeviceScene missing = make_device_scene(load_body(shape(mask("", red))));
    CHECK(shares(missing, false) == std::map<int, double>{{0, 0.5}, {1, 0.5}});
}

TEST_CASE("Blends: filters without polarisation are grey sheets, as in Mitsuba's RGB mode",
          "[blends]") {
    auto passes = [](const std::string& plugin, const std::string& inside) {
        DeviceScene flat = make_device_scene(
            load_body(shape("<bsdf type=\"" + plugin + "\">" + inside + "</bsdf>")));
        CHECK((shares(flat, false) == shares(flat, true)));
        for (const auto& [material, share] : shares(flat, false))
            if (flat.materials[static_cast<std::size_t>(material)].kind == material_null)
                return share;
        return 0.0;
    };
    // What its `sample` gives the direction straight on in Mitsuba 3.9.1 (scalar_rgb).
    std::string half =
        R"(<spectrum name="transmittance" value="0.5"/><float name="theta" value="30"/>)";
    CHECK(passes("polarizer", "") == 0.5);
    CHECK(passes("polarizer", half) == 0.25);
    CHECK(passes("polarizer", "<boolean name=\"polarizing\" value=\"false\"/>") == 0.5);
    CHECK(passes("circular", half) == 0.25);
    CHECK(passes("retarder", half) == 0.5);
    CHECK(passes("retarder", "") == 1);
    std::string colour = R"(<rgb name="transmittance" value="0.2,0.5,0.8"/>)";
    CHECK_THAT(refusal_of_body(shape("<bsdf type=\"polarizer\">" + colour + "</bsdf>")),
               Catch::Matchers::Contains("\"transmittance\" is a colour (accepted: a grey)"));
}

TEST_CASE("Blends: pplastic is roughplastic, and said to be", "[blends]") {
    const std::string inside =
        R"(<float name="alpha" value="0.2"/><string name="distribution" value="ggx"/>)";
    Scene scene = load_body(shape("<bsdf type=\"pplastic\">" + inside + "</bsdf>"));
    const auto& plastic = std::get<RoughPlasticBsdf>(scene.materials.at(0).bsdf);
    CHECK(plastic.roughness.alpha == 0.2);
    REQUIRE(scene.notes.size() == 1);
    CHECK_THAT(scene.notes[0],
               Catch::Matchers::Contains(
                   "scene.xml:2: bsdf plugin \"pplastic\" is read as \"roughplastic\""));
}

TEST_CASE("Blends: refusals", "[blends]") {
    auto refusal = [](const std::string& bsdf) { return refusal_of_body(shape(bsdf)); };
    using Catch::Matchers::Contains;
    CHECK_THAT(refusal(blend(number("weight", "0.5"), red)),
               Contains("scene.xml:2: bsdf plugin \"blendbsdf\" holds 1 bsdf (accepted: 2)"));
    CHECK_THAT(refusal(blend("", red + green)), Contains("lacks its parameter \"weight\""));
    CHECK_THAT(refusal(blend(number("weight", "1.5"), red + green)),
               Contains("parameter \"weight\" is 1.5 (accepted: 0 to 1)"));
    CHECK_THAT(refusal(mask("", "")), Contains("holds 0 bsdfs (accepted: 1)"));
    CHECK_THAT(refusal("<bsdf type=\"twosided\">" + mask("", red) + "</bsdf>"),
               Contains("cannot hold the bsdf plugin \"mask\", which light passes through"));
    CHECK_THAT(refusal("<bsdf type=\"mirror\"/>"), Contains("twosided, mask, blendbsdf"));
}

TEST_CASE("Blends: what a mask covers is its opacity, and behind it is the rest", "[blends]") {
    constexpr double opacity = 0.3, sky = 2;
    for (bool below : {false, true}) {
        Scene scene = sheet(0, 0, {{"", {}, NullBsdf{}}, {"", {}, DiffuseBsdf{Rgb(0)}}});
        Shape& s = scene.shapes[0];
        s.material_front = add_blend(scene, {opacity, 0, 1});
        s.material_back = add_blend(scene, {opacity, 0, no_material});
        if (below) s.geometry = quad({-9, -9, 0}, {0, 18, 0}, {18, 0, 0});
        scene.emitters = {ConstantEmitter{Rgb(sky)}};
        Image image = host_render(scene, Precision::single_precision).image;
        // A share of samples, 4096 of them in a pattern.
        CHECK(std::abs(mean(image, "R") - (1 - opacity) * sky) < 0.01);
        CHECK(std::abs(mean(image, "A") - 1) < 1e-6); // the sky covers what is left
        scene.integrator.hide_emitters = true;
        Image hidden = host_render(scene, Precision::single_precision).image;
        CHECK(std::abs(mean(hidden, "A") - opacity) < 0.005);
        CHECK(mean(hidden, "R") == 0);
    }
}

TEST_CASE("Blends: in a uniform sky the mean of the reflectances is seen", "[blends]") {
    ConductorBsdf mirror{{Rgb(0), Rgb(1)}, Rgb(0.9)};
    Scene scene = sheet(0, no_material,
                        {{"", {}, DiffuseBsdf{Rgb(0.8, 0.4, 0)}},
                         {"", {}, DiffuseBsdf{Rgb(0.2, 0.2, 0.6)}},
                         {"", {}, mirror}});
    int diffuse = add_blend(scene, {0.25, 0, 1});
    scene.shapes[0].material_front = add_blend(scene, {0.5, diffuse, 2});
    scene.emitters = {ConstantEmitter{Rgb(1)}};
    scene.integrator.aovs = {{"albedo", "albedo", {}}};
    Image image = host_render(scene, Precision::single_precision).image;
    Rgb expected = 0.5 * (0.75 * Rgb(0.8, 0.4, 0) + 0.25 * Rgb(0.2, 0.2, 0.6)) + 0.5 * Rgb(0.9);
    CHECK(std::abs(mean(image, "R") - expected.r) < 0.005);
    CHECK(std::abs(mean(image, "G") - expected.g) < 0.005);
    CHECK(std::abs(mean(image, "B") - expected.b) < 0.005);
    // Nothing is drawn for what is stored of it.
    CHECK(mean(image, "albedo.R") == Approx(expected.r).epsilon(1e-6));
    CHECK(mean(image, "albedo.B") == Approx(expected.b).epsilon(1e-6));
}

TEST_CASE("Blends: light that is sampled reaches all lobes of every path", "[blends]") {
    // Without noise: f of both, whichever of them a direction would have been drawn from.
    Scene scene =
        sheet(0, no_material, {{"", {}, DiffuseBsdf{Rgb(0.8)}}, {"", {}, DiffuseBsdf{Rgb(0.2)}}});
    scene.shapes[0].material_front = add_blend(scene, {0.25, 0, 1});
    scene.emitters = {PointEmitter{{0, 0, 3}, Rgb(5)}};
    DeviceScene flat = make_device_scene(scene);
    double expected = (0.75 * 0.8 + 0.25 * 0.2) / M_PI * 5 / 9;
    for (int sample = 0; sample < 32; sample++)
        CHECK(trace_sample(scene, flat, 4, 4, sample).radiance[0] ==
              Approx(expected).epsilon(2e-3)); // over the film the light is not quite overhead
}

TEST_CASE("Blends: a material with a copy of itself is that material, of every kind", "[blends]") {
    Scene alone = two_of_every();
    alone.sampler.samples_per_pixel = 32;
    alone.integrator.shading_normals = ShadingNormals::soft;
    Scene blended = alone;
    blend_with_copies(blended);
    CHECK(make_device_scene(blended).features.has(feature_blends));
    Image a = host_render(alone, Precision::double_precision).image;
    Image b = host_render(blended, Precision::double_precision).image;
    for (const char* channel : {"R", "G", "B", "A"}) {
        const auto &x = find_channel(a, channel)->values, &y = find_channel(b, channel)->values;
        for (std::size_t i = 0; i < x.size(); i++)
            CHECK(y[i] == Approx(x[i]).epsilon(1e-4));
    }
}

namespace {

/// A smooth sheet and a point of light before or behind it, which no direction that is drawn meets:
/// what is seen has no noise.
Scene lit_sheet(bool below, bool behind, std::vector<Material> materials) {
    Scene scene = sheet(0, 0, std::move(materials));
    Mesh mesh = below ? quad({-9, -9, 0}, {0, 18, 0}, {18, 0, 0})
                      : quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
    for (const glm::dvec3& corner : mesh.positions)
        mesh.normals.push_back((below ? -1.0 : 1.0) *
                               glm::normalize(glm::dvec3(0.3, 0.1 * corner.y / 9, 1)));
    scene.shapes[0].geometry = mesh;
    scene.emitters = {
        PointEmitter{behind ? glm::dvec3(-2, 0.5, -3) : glm::dvec3(4, 0.3, 1), Rgb(100)}};
    scene.integrator.shading_normals = ShadingNormals::soft;
    return scene;
}

float seen(const Scene& scene) {
    return trace_sample(scene, make_device_scene(scene), 4, 4, 7).radiance[0];
}

} // namespace

TEST_CASE("Blends: direct light is the weighted sum of both, of every pair of kinds", "[blends]") {
    int bright = 0;
    for (int side = 0; side < 4; side++)
        for (int a = 0; a < material_kind_count; a++)
            for (int b = 0; b < a; b++) {
                CAPTURE(side, a, b);
                std::vector<Material> materials = {
                    {"", {}, example_materials[static_cast<std::size_t>(a)](0)},
                    {"", {}, example_materials[static_cast<std::size_t>(b)](1)}};
                Scene scene = lit_sheet(side & 1, side & 2, materials);
                float first = seen(scene);
                scene.shapes[0].material_front = scene.shapes[0].material_back = 1;
                float second = seen(scene);
                int both = add_blend(scene, {0.3, 0, 1});
                scene.shapes[0].material_front = scene.shapes[0].material_back = both;
                CHECK(seen(scene) == Approx(0.7 * first + 0.3 * second).epsilon(1e-5));
                bright += first > 0 && second > 0;
            }
    CHECK(bright > 8); // those without a lobe of one direction alone
}

TEST_CASE("Blends: seen from inside, matte and glass are the same with all of the kernels",
          "[blends]") {
    const std::string glass = "<bsdf type=\"roughdielectric\"/>";
    Scene scene = load_body("<emitter type=\"constant\"/><shape type=\"sphere\">" +
                            blend(number("weight", "0.5"), red + glass) + "</shape>");
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 16;
    scene.sampler.samples_per_pixel = 16;
    scene.camera.to_world = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -4));
    RenderOptions all;
    all.all_features = true;
    const Image own = host_render(scene, Precision::single_precision).image;
    const Image of_all = host_render(scene, Precision::single_precision, all).image;
    for (std::size_t c = 0; c < own.channels.size(); c++)
        CHECK(own.channels[c].values == of_all.channels[c].values);
    CHECK(mean(own, "R") > mean(own, "G"));
}
