// What covers a pixel, and what a hidden emitter is: sheets that let rays straight through, opaque
// ones, lights and skies one behind the other. The figures are those of Mitsuba 3.9.1 (scalar_rgb),
// measured but for the rows tt, nt, tn and n0, which follow the rule of the others; R and alpha of
// a path are its own, so that noise is that of Fresnel's share alone.
#include "host/numerics/every_kind_scene.h"
#include "host/twin/sample_trace.h"
#include "tests/support/host_render.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

/// What a thin slab of the default glass sends back at normal incidence.
double slab_reflectance() {
    double eta = 1.5046 / 1.000277, r = (eta - 1) / (eta + 1);
    return 2 * r * r / (1 + r * r);
}
const double slab = slab_reflectance();

enum class Sky { none, dark, bright };

/// Sheets across the view, the nearest first: `n` null, `t` thin glass, `g` glass, `d` black, `l`
/// black and shining with radiance 2, `0` black and shining with none, `N` null and shining.
Scene layers(const std::string& sheets, Sky sky, bool hide) {
    Scene scene;
    scene.file = "made by the test";
    scene.materials = {{"n", {}, NullBsdf{}},
                       {"t", {}, ThinDielectricBsdf{}},
                       {"g", {}, DielectricBsdf{}},
                       {"d", {}, DiffuseBsdf{Rgb(0)}}};
    double z = 0;
    for (char sheet : sheets) {
        auto kind = std::string("ntgd").find(sheet == 'N' ? 'n' : sheet);
        int material = kind == std::string::npos ? 3 : static_cast<int>(kind);
        std::optional<Rgb> radiance;
        if (sheet == 'l' || sheet == 'N') radiance = Rgb(2);
        if (sheet == '0') radiance = Rgb(0);
        scene.shapes.push_back(shape_of(quad({-9, -9, z}, {18, 0, 0}, {0, 18, 0}), material,
                                        material == 3 ? no_material : material, radiance));
        z -= 1;
    }
    if (sky != Sky::none) scene.emitters = {ConstantEmitter{Rgb(sky == Sky::bright ? 1 : 0)}};
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 5, 1));
    scene.camera.fov_degrees = 2;
    scene.film.width = scene.film.crop_width = 4;
    scene.film.height = scene.film.crop_height = 3;
    scene.film.pixel_format = PixelFormat::rgba;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.hide_emitters = hide;
    scene.sampler.samples_per_pixel = 64;
    return scene;
}

struct Seen {
    double red, alpha;
};

Seen seen(const Scene& scene, Precision precision) {
    Image image = host_render(scene, precision).image;
    Seen sum{0, 0};
    for (std::size_t i = 0; i < image.pixel_count(); i++) {
        sum.red += find_channel(image, "R")->values[i];
        sum.alpha += find_channel(image, "A")->values[i];
    }
    auto count = static_cast<double>(image.pixel_count());
    return {sum.red / count, sum.alpha / count};
}

/// The same of single samples, told vertex by vertex.
Seen traced(const Scene& scene) {
    DeviceScene flat = make_device_scene(scene);
    Seen sum{0, 0};
    for (int sample = 0; sample < scene.sampler.samples_per_pixel; sample++) {
        SampleTrace trace = trace_sample(scene, flat, 1, 1, sample);
        sum.red += trace.radiance[0], sum.alpha += trace.alpha;
    }
    return {sum.red / scene.sampler.samples_per_pixel, sum.alpha / scene.sampler.samples_per_pixel};
}

void check_seen(const Scene& scene, Seen expected) {
    // 5 standard errors of a share that is exact where nothing is drawn.
    double samples = 12.0 * scene.sampler.samples_per_pixel;
    auto error = [](double share, double n) {
        double s = std::min(std::abs(share - std::round(share)), 0.5);
        return 1e-6 + 5 * 2 * std::sqrt(s / n);
    };
    for (Precision precision : {Precision::single_precision, Precision::double_precision}) {
        Seen s = seen(scene, precision);
        CHECK(std::abs(s.red - expected.red) < error(expected.red, samples));
        CHECK(std::abs(s.alpha - expected.alpha) < error(expected.alpha, samples));
    }
    Seen t = traced(scene);
    CHECK(std::abs(t.red - expected.red) < error(expected.red, samples / 12));
    CHECK(std::abs(t.alpha - expected.alpha) < error(expected.alpha, samples / 12));
}

} // namespace

TEST_CASE("Alpha of a path: the first scattering that is not straight on covers", "[alpha]") {
    struct Row {
        const char* sheets;
        Sky sky;
        bool hide;
        Seen seen;
    };
    double t = slab, t2 = t + (1 - t) * t;
    for (const Row& r :
         {Row{"", Sky::none, false, {0, 0}},         Row{"", Sky::bright, false, {1, 1}},
          Row{"", Sky::bright, true, {0, 0}},        Row{"", Sky::dark, false, {0, 1}},
          Row{"", Sky::dark, true, {0, 0}},          Row{"n", Sky::none, false, {0, 0}},
          Row{"n", Sky::none, true, {0, 0}},         Row{"n", Sky::bright, false, {1, 1}},
          Row{"n", Sky::bright, true, {0, 0}},       Row{"n", Sky::dark, false, {0, 1}},
          Row{"n", Sky::dark, true, {0, 0}},         Row{"nn", Sky::none, false, {0, 0}},
          Row{"nn", Sky::bright, false, {1, 1}},     Row{"nn", Sky::bright, true, {0, 0}},
          Row{"d", Sky::none, false, {0, 1}},        Row{"d", Sky::bright, true, {0, 1}},
          Row{"nd", Sky::none, false, {0, 1}},       Row{"nd", Sky::bright, true, {0, 1}},
          Row{"t", Sky::none, false, {0, t}},        Row{"t", Sky::bright, false, {1, 1}},
          Row{"t", Sky::bright, true, {t, t}},       Row{"t", Sky::dark, true, {0, t}},
          Row{"tt", Sky::bright, true, {t2, t2}},    Row{"nt", Sky::bright, true, {t, t}},
          Row{"td", Sky::none, false, {0, 1}},       Row{"tn", Sky::bright, true, {t, t}},
          Row{"g", Sky::none, false, {0, 1}},        Row{"g", Sky::dark, true, {0, 1}},
          Row{"l", Sky::none, false, {2, 1}},        Row{"l", Sky::none, true, {0, 0}},
          Row{"l", Sky::bright, false, {2, 1}},      Row{"l", Sky::bright, true, {0, 0}},
          Row{"0", Sky::none, false, {0, 1}},        Row{"0", Sky::none, true, {0, 0}},
          Row{"0", Sky::bright, true, {0, 0}},       Row{"ld", Sky::none, true, {0, 1}},
          Row{"0d", Sky::none, true, {0, 1}},        Row{"ln", Sky::bright, true, {0, 0}},
          Row{"nl", Sky::none, false, {2, 1}},       Row{"nl", Sky::none, true, {2, 1}},
          Row{"nld", Sky::bright, true, {2, 1}},     Row{"n0", Sky::none, true, {0, 1}},
          Row{"tl", Sky::none, true, {2 - 2 * t, 1}}}) {
        CAPTURE(r.sheets, int(r.sky), r.hide);
        check_seen(layers(r.sheets, r.sky, r.hide), r.seen);
    }
}

// At the last vertex, unlike Mitsuba's, something opaque covers as it does at any other.
TEST_CASE("Alpha of short paths: a sheet counts as a vertex, and at the last one nothing scatters",
          "[alpha]") {
    struct Row {
        const char* sheets;
        Sky sky;
        bool hide;
        int max_depth;
        Seen seen;
    };
    double t = slab;
    for (const Row& r :
         {Row{"n", Sky::none, false, 1, {0, 0}}, Row{"n", Sky::bright, false, 1, {0, 1}},
          Row{"n", Sky::bright, true, 1, {0, 0}}, Row{"n", Sky::bright, false, 2, {1, 1}},
          Row{"n", Sky::bright, true, 2, {0, 0}}, Row{"nn", Sky::bright, false, 2, {0, 1}},
          Row{"nn", Sky::bright, false, 3, {1, 1}}, Row{"nn", Sky::none, false, 2, {0, 0}},
          Row{"nl", Sky::none, false, 1, {0, 0}}, Row{"nl", Sky::none, false, 2, {2, 1}},
          Row{"nl", Sky::none, true, 3, {2, 1}}, Row{"nd", Sky::none, false, 3, {0, 1}},
          Row{"t", Sky::none, false, 1, {0, 0}}, Row{"t", Sky::bright, true, 1, {0, 0}},
          Row{"t", Sky::none, false, 2, {0, t}}, Row{"t", Sky::bright, true, 2, {t, t}},
          Row{"td", Sky::bright, true, 2, {t, 1}}, Row{"l", Sky::none, false, 1, {2, 1}},
          Row{"l", Sky::none, true, 1, {0, 0}}}) {
        CAPTURE(r.sheets, int(r.sky), r.hide, r.max_depth);
        Scene scene = layers(r.sheets, r.sky, r.hide);
        scene.integrator.max_depth = r.max_depth;
        check_seen(scene, r.seen);
    }
}

TEST_CASE("Alpha of direct light and of views: what is hit first covers, whatever it is",
          "[alpha]") {
    for (IntegratorKind kind : {IntegratorKind::direct, IntegratorKind::normals}) {
        bool direct = kind == IntegratorKind::direct;
        auto check = [&](const char* sheets, Sky sky, bool hide, Seen expected) {
            CAPTURE(int(kind), sheets, int(sky), hide);
            Scene scene = layers(sheets, sky, hide);
            scene.integrator.kind = kind;
            if (!direct) expected.red = expected.alpha * 0.5; // x of the normal, from -1 to 1
            check_seen(scene, expected);
        };
        check("", Sky::bright, false, {1, 0});
        check("", Sky::bright, true, {0, 0});
        check("n", Sky::none, false, {0, 1});
        check("n", Sky::bright, true, {1, 1});
        check("nn", Sky::bright, false, {0, 1});
        check("t", Sky::none, false, {0, 1});
        check("l", Sky::none, true, {0, 0});
        check("nl", Sky::none, true, {2, 1});
    }
}

TEST_CASE("Russian roulette counts a sheet as a vertex, and paths behind it weigh as much more",
          "[alpha]") {
    Scene scene = layers("nnn", Sky::bright, false);
    scene.integrator.rr_depth = 2;
    scene.integrator.second_moment = true;
    scene.sampler.pattern = SamplePattern::independent;
    scene.sampler.samples_per_pixel = 4096;
    // At the second sheet and the third a path survives with 0.95; the mean of squares is 1 /
    // 0.95^2.
    Image image = host_render(scene, Precision::single_precision).image;
    double mean = 0, square = 0;
    for (std::size_t i = 0; i < image.pixel_count(); i++) {
        mean += find_channel(image, "R")->values[i] / 12;
        square += find_channel(image, "second_moment.R")->values[i] / 12;
    }
    CHECK(mean == Approx(1).margin(5 * std::sqrt((1 / 0.9025 - 1) / (12 * 4096))));
    CHECK(square == Approx(1 / 0.9025).epsilon(0.01));
}

TEST_CASE("A hidden sky lights what it shines on", "[alpha]") {
    // Every direction above the sheet sees the sky: albedo times radiance, with no noise where
    // directions are the BSDF's choice.
    for (const char* sheets : {"d", "nd"})
        for (bool next_event : {false, true}) {
            CAPTURE(sheets, next_event);
            Scene scene = layers(sheets, Sky::bright, true);
            scene.materials.back().bsdf = DiffuseBsdf{Rgb(0.25)};
            scene.integrator.emitter_samples = next_event;
            scene.sampler.samples_per_pixel = next_event ? 4096 : 4;
            for (Precision precision : {Precision::single_precision, Precision::double_precision})
                CHECK(seen(scene, precision).red == Approx(0.25).epsilon(next_event ? 0.02 : 1e-6));
        }
}
