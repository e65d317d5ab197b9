// Small pictures whose every value is known: hidden emitters, alpha, pixel formats, moments and
// variances in the scene's unit, profiles of filters in both directions.
#include "tests/support/first_hits.h"

#include <fmt/format.h>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;

namespace {

/// Beside every camera here, and out of every mirror.
const std::string unseen = "<shape type=\"sphere\"><point name=\"center\" x=\"0\" y=\"300\" "
                           "z=\"20\"/></shape>";

const std::string sky = unseen +
                        "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.3 0.5 0.9\"/>"
                        "</emitter>";

std::string small_film(const std::string& more = "") {
    return "<integer name=\"width\" value=\"6\"/><integer name=\"height\" value=\"4\"/>"
           "<rfilter type=\"box\"/>" +
           more;
}

std::string wall(double half_width, const std::string& bsdf) {
    return fmt::format("<shape type=\"rectangle\"><transform name=\"to_world\"><scale "
                       "value=\"{}\"/></transform>{}</shape>",
                       half_width, bsdf);
}

std::string integrator(const std::string& kind, bool hide, int max_depth) {
    return fmt::format(
        "<integrator type=\"{}\"><boolean name=\"hide_emitters\" value=\"{}\"/>{}"
        "</integrator>",
        kind, hide,
        kind == "path" ? fmt::format("<integer name=\"max_depth\" value=\"{}\"/>", max_depth) : "");
}

const std::string mirror =
    "<bsdf type=\"conductor\"><string name=\"material\" value=\"none\"/></bsdf>";

/// The mean of a channel.
double mean_of(const Image& image, const std::string& channel) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixel_count(); i++)
        sum += value_at(image, channel, i);
    return sum / double(image.pixel_count());
}

void check_everywhere(const Image& image, const std::string& channel, double expected,
                      double margin = 1e-6) {
    INFO(channel);
    for (std::size_t i = 0; i < image.pixel_count(); i++)
        REQUIRE(value_at(image, channel, i) == Approx(expected).margin(margin));
}

Image picture(const std::string& body, int samples = 4) {
    Scene scene = scene_of_text(body);
    scene.sampler.samples_per_pixel = samples;
    return host_image(scene);
}

const std::string fov = "<float name=\"fov\" value=\"20\"/>";

} // namespace

TEST_CASE("Picture truths: a sky that is hidden is hidden from the camera alone", "[truths]") {
    for (const char* kind : {"path", "direct"})
        for (bool hide : {false, true}) {
            INFO(kind << ", hidden " << hide);
            std::string head = integrator(kind, hide, 3) + sky;
            // Straight at it.
            Image straight = picture(head + looking_down(5, fov, small_film()));
            check_everywhere(straight, "R", hide ? 0 : 0.3);
            check_everywhere(straight, "B", hide ? 0 : 0.9);
            check_everywhere(straight, "A", hide || kind == std::string("direct") ? 0 : 1);
            // In a mirror that loses nothing: Fresnel of index 0 + 1i is 1.
            Image mirrored = picture(head + wall(99, mirror) + looking_down(5, fov, small_film()));
            check_everywhere(mirrored, "R", 0.3);
            check_everywhere(mirrored, "B", 0.9);
            check_everywhere(mirrored, "A", 1);
            // On a white wall that sees nothing else: reflectance times radiance.
            Image lit = picture(head +
                                    wall(99, "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
                                             "value=\"0.8\"/></bsdf>") +
                                    looking_down(5, fov, small_film()),
                                4096);
            CHECK(mean_of(lit, "R") == Approx(0.24).epsilon(0.003));
            CHECK(mean_of(lit, "B") == Approx(0.72).epsilon(0.003));
        }
}

TEST_CASE("Picture truths: a lamp that is hidden shines all the same", "[truths]") {
    // A lamp that fills the picture, before a mirror that shows its back and a floor.
    std::string lamp = "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"9\"/>"
                       "<translate z=\"1\"/></transform><emitter type=\"area\"><rgb "
                       "name=\"radiance\" value=\"2 3 4\"/></emitter></shape>";
    for (bool hide : {false, true}) {
        Image image =
            picture(integrator("path", hide, 2) + lamp + looking_down(5, fov, small_film()));
        check_everywhere(image, "G", hide ? 0 : 3);
        check_everywhere(image, "A", hide ? 0 : 1);
    }
}

TEST_CASE("Picture truths: pixel formats are those of BT.709 and the CIE", "[truths]") {
    // Rows of the matrix from BT.709's primaries and D65 to XYZ, as Mitsuba 3 has them.
    const double r = 0.3, g = 0.5, b = 0.9;
    const double x = 0.412453 * r + 0.357580 * g + 0.180423 * b;
    const double y = 0.212671 * r + 0.715160 * g + 0.072169 * b;
    const double z = 0.019334 * r + 0.119193 * g + 0.950227 * b;
    struct Format {
        const char* name;
        std::vector<std::pair<const char*, double>> channels;
    };
    const Format formats[] = {{"rgb", {{"R", r}, {"G", g}, {"B", b}}},
                              {"rgba", {{"R", r}, {"G", g}, {"B", b}, {"A", 1}}},
                              {"luminance", {{"Y", y}}},
                              {"luminance_alpha", {{"Y", y}, {"A", 1}}},
                              {"xyz", {{"X", x}, {"Y", y}, {"Z", z}}},
                              {"xyza", {{"X", x}, {"Y", y}, {"Z", z}, {"A", 1}}}};
    for (const Format& format : formats) {
        INFO(format.name);
        std::string text = integrator("path", false, 2) + sky + looking_down(5, fov, small_film());
        text.replace(text.find("value=\"rgba\""), 12, fmt::format("value=\"{}\"", format.name));
        Image image = picture(text);
        CHECK(image.channels.size() == format.channels.size());
        for (const auto& [channel, value] : format.channels)
            check_everywhere(image, channel, value, 3e-7);
    }
}

TEST_CASE("Picture truths: variances and moments of depth are in the scene's unit", "[truths]") {
    // Through a pinhole narrow enough for every ray to be as good as straight: half of the
    // picture's walls at the distance a, half at b, their edge within a pixel.
    for (double size : {1.0, 0.01, 300.0}) {
        INFO("size " << size);
        auto half = [&](double z, double x) {
            return fmt::format("<shape type=\"rectangle\"><transform name=\"to_world\"><translate "
                               "x=\"{}\"/><scale value=\"{}\"/><translate z=\"{}\"/></transform>"
                               "</shape>",
                               x, size, z * size);
        };
        std::string sensor = fmt::format("<float name=\"fov\" value=\"0.1\"/><float "
                                         "name=\"near_clip\" value=\"{}\"/>",
                                         1e-3 * size);
        std::string text = "<integrator type=\"moment\"><integrator type=\"depth\"/></integrator>" +
                           half(1, 1) + half(-1, -1) + looking_down(5 * size, sensor, small_film());
        // The edge of the near wall lies between pixels; moved by the principal point into one.
        text.replace(text.find("<sampler"), 0,
                     "<float name=\"principal_point_offset_x\" value=\"0.05\"/>");
        Scene scene = scene_of_text(text);
        constexpr int samples = 200;
        scene.sampler.samples_per_pixel = samples;
        scene.integrator.aovs = {{"variance", "variance", {}}, {"samples", "samples", {}}};
        Image image = host_image(scene);
        const double a = 3.999 * size, b = 5.999 * size;
        int mixed = 0;
        for (std::size_t i = 0; i < image.pixel_count(); i++) {
            double mean = value_at(image, "R", i), share = (b - mean) / (b - a);
            REQUIRE(share > -1e-5);
            REQUIRE(share < 1 + 1e-5);
            double truth = share * (1 - share) * (b - a) * (b - a) * samples / (samples - 1);
            REQUIRE(value_at(image, "variance.R", i) ==
                    Approx(truth).margin(1e-4 * size * size).epsilon(1e-4));
            REQUIRE(value_at(image, "second_moment.R", i) ==
                    Approx(share * a * a + (1 - share) * b * b).epsilon(1e-5));
            REQUIRE(value_at(image, "samples.N", i) == samples);
            mixed += share > 0.1 && share < 0.9;
        }
        CHECK(mixed == 4);
    }
}

TEST_CASE("Picture truths: in a closed ball with a lamp every path has all of its rays",
          "[truths]") {
    const std::string ball =
        "<shape type=\"sphere\"><boolean name=\"flip_normals\" value=\"true\"/><float "
        "name=\"radius\" value=\"9\"/></shape><emitter type=\"point\"><point name=\"position\" "
        "x=\"1\" y=\"2\" z=\"0\"/></emitter>";
    for (int max_depth : {1, 2, 4}) {
        CAPTURE(max_depth);
        Scene scene = scene_of_text(integrator("path", false, max_depth) + ball +
                                    looking_down(5, fov, small_film()));
        scene.sampler.samples_per_pixel = 5;
        Progress quiet(Progress::Mode::quiet);
        RenderReport report = render_on_host(scene, {}, Precision::single_precision, quiet).report;
        const auto paths = std::uint64_t(6 * 4 * 5),
                   vertices = paths * std::uint64_t(max_depth - 1);
        CHECK(report.paths == paths);
        CHECK(report.camera_rays == paths);
        CHECK(report.shadow_rays == vertices);
        // From the last vertex that is lit no ray goes on: it would meet nothing that shines.
        CHECK(report.bounce_rays == (max_depth > 1 ? vertices - paths : 0));
    }
}
