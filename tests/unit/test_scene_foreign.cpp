// What other programs' files and other versions of Mitsuba write: films, samplers, spectra,
// integrators, no sensor or several.
#include "host/scene/mitsuba/versions.h"
#include "test_scene_tools.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using Catch::Matchers::Contains;

namespace {

Scene load_text(const std::string& text, const LoadOptions& options = {},
                const std::string& version = "3.0.0") {
    const SceneFolder folder;
    return load_scene(
        folder.write("scene.xml", "<scene version=\"" + version + "\">\n" + text + "</scene>"),
        options);
}

bool notes(const Scene& scene, const std::string& part) {
    return std::any_of(scene.notes.begin(), scene.notes.end(), [&](const std::string& note) {
        return note.find(part) != std::string::npos;
    });
}

/// Of a lamp with this element.
Rgb radiance_of(const std::string& element, const std::string& version = "3.0.0") {
    return *load_text("<shape type=\"sphere\"><emitter type=\"area\">" + element +
                          "</emitter></shape>",
                      {}, version)
                .shapes.at(0)
                .radiance;
}

void check_color(const Rgb& found, const Rgb& expected, double relative) {
    INFO(found.r << " " << found.g << " " << found.b);
    for (int c = 0; c < 3; c++)
        CHECK(found[c] == Approx(expected[c]).epsilon(relative));
}

} // namespace

TEST_CASE("scene foreign: films of Mitsuba 0.x are hdrfilm") {
    const Scene ldr = load_text(
        "<sensor type=\"perspective\"><film type=\"ldrfilm\"><integer name=\"width\" value=\"7\"/>"
        "<float name=\"gamma\" value=\"2.2\"/><string name=\"fileFormat\" value=\"png\"/>"
        "<string name=\"pixelFormat\" value=\"luminanceAlpha\"/>"
        "<string name=\"tonemapMethod\" value=\"reinhard\"/></film></sensor>",
        {}, "0.6.0");
    CHECK(ldr.film.width == 7);
    CHECK(ldr.film.pixel_format == PixelFormat::luminance_alpha);
    CHECK(notes(ldr, "is read as \"hdrfilm\""));
    CHECK(notes(ldr, "--output chooses"));
    for (const std::string film : {"mfilm", "tiledhdrfilm"}) {
        const Scene scene =
            load_text("<sensor type=\"perspective\"><film type=\"" + film + "\"/></sensor>");
        CHECK(scene.film.width == 768);
        CHECK(notes(scene, "film \"" + film + "\" is read as \"hdrfilm\""));
    }
}

TEST_CASE("scene foreign: samplers of Mitsuba 0.x change the noise alone") {
    for (const std::string name : {"sobol", "halton", "hammersley"}) {
        const Scene scene = load_text("<sensor type=\"perspective\"><sampler type=\"" + name +
                                          "\"><integer name=\"sampleCount\" value=\"64\"/>"
                                          "<integer name=\"scramble\" value=\"-1\"/>"
                                          "<integer name=\"dimension\" value=\"9\"/></sampler>"
                                          "</sensor>",
                                      {}, "0.5.0");
        CHECK(scene.sampler.samples_per_pixel == 64);
        CHECK(notes(scene, "sampler \"" + name + "\" does not choose the pattern"));
    }
}

TEST_CASE("scene foreign: samples_per_pass holds what Mitsuba's does") {
    const std::string integrator = "<integrator type=\"path\"><integer name=\"samples_per_pass\" "
                                   "value=\"4294967295\"/></integrator>";
    CHECK(load_text(integrator).integrator.kind == IntegratorKind::path);
}

// By eval() of emitters and BSDFs in Mitsuba 3.9.1, scalar_rgb.
TEST_CASE("scene foreign: spectra that are plugins") {
    const auto spectrum = [](const std::string& type, const std::string& inside) {
        return "<spectrum name=\"radiance\" type=\"" + type + "\">" + inside + "</spectrum>";
    };
    CHECK(radiance_of(spectrum("d65", "")) == Rgb(1.0));
    CHECK(radiance_of(spectrum("d65", "<float name=\"scale\" value=\"3\"/>")) == Rgb(3.0));
    CHECK(radiance_of(spectrum("d65", "<rgb name=\"color\" value=\"0.3 0.2 0.1\"/>")) ==
          Rgb(0.3, 0.2, 0.1));
    CHECK(radiance_of(spectrum("uniform", "<float name=\"value\" value=\"0.3\"/>")) == Rgb(0.3));
    CHECK(radiance_of(spectrum("srgb", "<rgb name=\"color\" value=\"0.3 0.2 0.1\"/>")) ==
          Rgb(0.3, 0.2, 0.1));
    const Scene scene = load_body("<shape type=\"sphere\"><bsdf type=\"diffuse\"><texture "
                                  "name=\"reflectance\" type=\"d65\"/></bsdf></shape>");
    CHECK(std::get<DiffuseBsdf>(scene.materials.at(0).bsdf).reflectance == Rgb(1.0));
    CHECK_THAT(refusal_of_body("<emitter type=\"constant\">\n<spectrum name=\"radiance\" "
                               "type=\"d65\"><float name=\"tint\" value=\"1\"/></spectrum>\n"
                               "</emitter>"),
               Contains("scene.xml:3") && Contains("spectrum plugin \"d65\" has no parameter"));
}

TEST_CASE("scene foreign: a black body is Planck's law, as spectrum and as element") {
    // Luminance is the integral with the observer's y over that of y: at 5000 K between the values
    // of Planck's law at 500 and 600 nm, 1.21e4 and 1.28e4 W/(m^2 sr nm).
    const Rgb plugin = radiance_of("<spectrum name=\"radiance\" type=\"blackbody\"><float "
                                   "name=\"temperature\" value=\"5000\"/></spectrum>");
    const double luminance = 0.212671 * plugin.r + 0.715160 * plugin.g + 0.072169 * plugin.b;
    CHECK(luminance > 1.21e4);
    CHECK(luminance < 1.28e4);
    // Chromaticity of 5000 K on the Planckian locus: x = 0.3451, y = 0.3516 (CIE 15).
    const glm::dvec3 xyz = {0.412453 * plugin.r + 0.357580 * plugin.g + 0.180423 * plugin.b,
                            luminance,
                            0.019334 * plugin.r + 0.119193 * plugin.g + 0.950227 * plugin.b};
    CHECK(xyz.x / (xyz.x + xyz.y + xyz.z) == Approx(0.3451).epsilon(1e-3));
    CHECK(xyz.y / (xyz.x + xyz.y + xyz.z) == Approx(0.3516).epsilon(1e-3));
    const Rgb element =
        radiance_of("<blackbody name=\"radiance\" temperature=\"5000K\" scale=\"2\"/>", "0.6.0");
    check_color(element, 2.0 * plugin, 1e-12);
    CHECK_THAT(refusal_of_body("<emitter type=\"constant\"><blackbody name=\"radiance\" "
                               "temperature=\"hot\"/></emitter>"),
               Contains("scene.xml:2") && Contains("\"hot\"") && Contains("kelvins"));
}

TEST_CASE("scene foreign: <srgb> is decoded") {
    // IEC 61966-2-1: 0.5 is 0.214041, 0.04 is 0.04 / 12.92.
    check_color(radiance_of("<srgb name=\"radiance\" value=\"0.5 0.04 1\"/>", "0.6.0"),
                Rgb(0.21404114, 0.04 / 12.92, 1.0), 1e-6);
    CHECK(radiance_of("<srgb name=\"radiance\" value=\"#8000ff\"/>") ==
          radiance_of("<rgb name=\"radiance\" value=\"#8000ff\"/>"));
}

TEST_CASE("scene foreign: a spectrum without wavelengths is linear RGB in Mitsuba 0.x alone") {
    const std::string three = "<spectrum name=\"radiance\" value=\"1, 2, 3\"/>",
                      one = "<spectrum name=\"radiance\" value=\"0.5\"/>";
    CHECK(radiance_of(three, "0.5.0") == Rgb(1, 2, 3));
    CHECK(radiance_of(one, "0.5.0") == Rgb(0.5));
    check_color(radiance_of(one), Rgb(0.602397, 0.474146, 0.454458), 1e-5); // Mitsuba 3.9.1
    CHECK(notes(load_text("<emitter type=\"constant\">" + one + "</emitter>", {}, "0.5.0"),
                "linear RGB"));
    CHECK_THAT(refusal_of_body("<emitter type=\"constant\">" + three + "</emitter>"),
               Contains("\"1\" is not a wavelength:value pair") && Contains("<rgb>"));
}

TEST_CASE("scene foreign: indices of metals below zero are their magnitudes") {
    // Mitsuba 3.9.1 reflects 0.819005, 0.852941, 0.887745 of either sign at normal incidence.
    const Scene scene =
        load_body("<bsdf type=\"conductor\" id=\"a\"><rgb name=\"eta\" "
                  "value=\"-0.1 0.2 0.3\"/><rgb name=\"k\" value=\"1 -2 3\"/></bsdf>"
                  "<shape type=\"sphere\"><ref id=\"a\"/></shape>");
    const auto metal = std::get<ConductorBsdf>(scene.materials.at(0).bsdf);
    CHECK(metal.index.eta == Rgb(0.1, 0.2, 0.3));
    CHECK(metal.index.k == Rgb(1, 2, 3));
    CHECK(notes(scene, "\"eta\" is negative"));
}

// By Mitsuba 3.9.1's mitsuba.parser.transform_upgrade.
TEST_CASE("scene foreign: old texture coordinates become a transform") {
    mitsuba::Object texture{"texture", "bitmap", "", {}, {}, {}};
    texture.parameters = {{"uoffset", "uoffset", "float", {}, 2.0},
                          {"filename", "filename", "string", {}, std::string("a.png")},
                          {"uscale", "uscale", "float", {}, 3.0},
                          {"vscale", "vscale", "integer", {}, std::int64_t(5)}};
    mitsuba::upgrade_old_object(texture);
    REQUIRE(texture.parameters.size() == 2);
    CHECK(texture.parameters[1].name == "to_uv");
    const auto& matrix = std::get<glm::dmat4>(texture.parameters[1].value);
    CHECK(matrix[0] == glm::dvec4(3, 0, 0, 0));
    CHECK(matrix[1] == glm::dvec4(0, 5, 0, 0));
    CHECK(matrix[3] == glm::dvec4(6, 0, 0, 1));
}

TEST_CASE("scene foreign: an integrator of another program is replaced by the caller's") {
    const std::string text = "<integrator type=\"sppm\"><integer name=\"maxDepth\" value=\"7\"/>"
                             "<boolean name=\"hideEmitters\" value=\"true\"/>"
                             "<integer name=\"photonCount\" value=\"9\"/></integrator>";
    LoadOptions given;
    given.own_integrator = true;
    const Scene scene = load_text(text, given, "0.6.0");
    CHECK(scene.integrator.max_depth == 7);
    CHECK(scene.integrator.hide_emitters);
    CHECK(notes(scene, "\"sppm\" is not known"));
    CHECK(notes(scene, "left out: photonCount"));
    CHECK_THROWS_AS(load_text(text, {}, "0.6.0"), InputError);
    // What is known is read as ever.
    CHECK_THROWS_AS(load_text("<integrator type=\"path\"><float name=\"x\" value=\"1\"/>"
                              "</integrator>",
                              given),
                    InputError);
}

TEST_CASE("scene foreign: of several sensors the first is used, or the one that is asked for") {
    const std::string text = "<sensor type=\"perspective\" id=\"front\"><float name=\"fov\" "
                             "value=\"30\"/></sensor><sensor type=\"perspective\"><float "
                             "name=\"fov\" value=\"40\"/></sensor>";
    const Scene first = load_text(text);
    CHECK(first.camera.fov_degrees == 30.0);
    CHECK(first.sensors == std::vector<std::string>{"front", "sensor 1"});
    CHECK(notes(first, "2 sensors (front, sensor 1); the first is used"));
    LoadOptions options;
    options.sensor = 1;
    const Scene second = load_text(text, options);
    CHECK(second.camera.fov_degrees == 40.0);
    CHECK_FALSE(notes(second, "the first is used"));
    options.sensor = 2;
    CHECK_THROWS_WITH(load_text(text, options),
                      Contains("--sensor 2") && Contains("accepted: 0 to 1"));
}

TEST_CASE("scene foreign: what is wrong with a sensor that is not chosen is noted") {
    const std::string text = "<sensor type=\"perspective\"/>\n<sensor type=\"fisheye\"/>\n"
                             "<sensor type=\"perspective\"><float name=\"fov\" value=\"0\"/>"
                             "</sensor>";
    const Scene scene = load_text(text);
    CHECK(notes(scene, "\"fisheye\""));
    CHECK(notes(scene, "\"fov\" is 0"));
    CHECK(notes(scene, "it is not the chosen sensor"));
    LoadOptions options;
    options.sensor = 2;
    CHECK_THROWS_WITH(load_text(text, options), Contains("\"fov\" is 0"));
}

// As Mitsuba 2 writes it down in its scene.cpp: 45 degrees, along +z, far enough for the largest
// extent of the box around all shapes to fill the view.
TEST_CASE("scene foreign: without a sensor all shapes are seen along +z") {
    const Scene scene = load_text("<shape type=\"sphere\"><point name=\"center\" x=\"3\" y=\"2\" "
                                  "z=\"1\"/><float name=\"radius\" value=\"2\"/></shape>"
                                  "<shape type=\"cube\"/>");
    const double distance = 6.0 / (2.0 * std::tan(std::acos(-1.0) / 8.0)); // box: 6 x 5 x 4
    CHECK(scene.camera.fov_degrees == 45.0);
    const glm::dvec3 place(scene.camera.to_world[3]), expected(2.0, 1.5, -1.0 - distance);
    CHECK(glm::length(place - expected) < 1e-12);
    CHECK(glm::dvec3(scene.camera.to_world[2]) == glm::dvec3(0, 0, 1));
    CHECK(scene.camera.near_clip == Approx(distance / 100));
    CHECK(scene.camera.far_clip == Approx(30 + distance));
    CHECK(scene.film.width == 768);
    CHECK(scene.sampler.samples_per_pixel == 4);
    CHECK(notes(scene, "has no <sensor>"));
    LoadOptions options;
    options.sensor = 0;
    CHECK_THROWS_WITH(load_text("", options), Contains("accepted: none"));
}
