// The variance that an image tells of itself: against sums of squares, and against the spread of
// many images.
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/statistics.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace parhelion;
using namespace parhelion::numerics;
using namespace parhelion::test;

namespace {

struct Setting {
    const char* name;
    FilterKind filter;
    FilterMethod method;
    SamplePattern pattern;
};

Scene scene_of(const Setting& setting, int samples) {
    Scene scene = every_kind_scene();
    scene.film.filter.kind = setting.filter;
    scene.film.filter_method = setting.method;
    scene.sampler.pattern = setting.pattern;
    scene.sampler.samples_per_pixel = samples;
    return scene;
}

const std::vector<float>& channel(const Image& image, const std::string& name) {
    return find_channel(image, name)->values;
}

const Setting boxed{"box", FilterKind::box, FilterMethod::splatting, SamplePattern::independent};

/// Variance of the pixels' values over the seeds, over what the images say of it; sums over pixels.
double honesty(const Setting& setting, int samples = 24) {
    constexpr int seeds = 64;
    Scene scene = scene_of(setting, samples);
    std::vector<Mean> pixels(scene.film.width * scene.film.height);
    std::vector<double> said(pixels.size());
    for (int seed = 0; seed < seeds; seed++) {
        scene.sampler.seed = seed;
        Image image = render_quietly(scene).image;
        for (std::size_t i = 0; i < pixels.size(); i++) {
            pixels[i].add(channel(image, "G")[i]);
            said[i] += channel(image, "variance.G")[i] / channel(image, "samples.N")[i] / seeds;
        }
    }
    // Each pixel for itself: a few are far noisier than all others together.
    std::vector<double> ratios;
    for (std::size_t i = 0; i < pixels.size(); i++)
        if (said[i] > 0) ratios.push_back(pixels[i].error() * pixels[i].error() * seeds / said[i]);
    double sum = 0;
    for (double ratio : ratios)
        sum += ratio;
    return sum / static_cast<double>(ratios.size());
}

} // namespace

TEST_CASE("Variance is the second moment less the square of the mean, and every sample is counted",
          "[render]") {
    constexpr int samples = 50; // groups of 16, and a rest
    Image image = render_quietly(scene_of(boxed, samples)).image;
    double worst = 0;
    for (const char* color : {"R", "G", "B"})
        for (std::size_t i = 0; i < image.pixel_count(); i++) {
            double mean = channel(image, color)[i];
            double square = channel(image, fmt::format("second_moment.{}", color))[i];
            double expected = (square - mean * mean) * samples / (samples - 1);
            double found = channel(image, fmt::format("variance.{}", color))[i];
            worst = std::max(worst, std::abs(found - expected) / (square + 1e-20));
            CHECK(found >= 0);
        }
    fmt::print("variance against sums of squares: off by {:.1e} of the second moment\n", worst);
    CHECK(worst < 1e-6);
    for (float count : channel(image, "samples.N"))
        CHECK(count == samples);
}

TEST_CASE("The variance of a pixel's value is that of one sample over their number, where samples "
          "are independent",
          "[render]") {
    const FilterMethod splat = FilterMethod::splatting, sampled = FilterMethod::sampling;
    const SamplePattern independent = SamplePattern::independent;
    double box = honesty(boxed);
    double gaussian = honesty({"gaussian", FilterKind::gaussian, sampled, independent});
    // Weights of both signs make the value a ratio, whose variance is known for many samples only.
    double mitchell = honesty({"mitchell", FilterKind::mitchell, sampled, independent}, 96);
    double splatted = honesty({"gaussian", FilterKind::gaussian, splat, independent});
    double pattern = honesty({"box", FilterKind::box, splat, SamplePattern::faure});
    fmt::print("variance over what the image says: box {:.3f}, gaussian {:.3f}, mitchell {:.3f}; "
               "splatted gaussian {:.3f}, box of the pattern {:.3f}\n",
               box, gaussian, mitchell, splatted, pattern);
    // A variance over 64 seeds is within 18 % of the truth, and there are 1200 pixels; tails are
    // heavy.
    for (double honest : {box, gaussian, mitchell, splatted})
        CHECK(std::abs(honest - 1) < 0.05);
    CHECK(pattern < 0.9);
}

TEST_CASE("Without noise there is no variance", "[render]") {
    Scene scene;
    scene.file = "made by the test";
    scene.emitters = {ConstantEmitter{Rgb(1000.1, 0.7, 1 / 3.0)}};
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 9;
    scene.integrator.aovs = {{"variance", "variance", {}}};
    scene.sampler.samples_per_pixel = 40;
    for (FilterKind kind : {FilterKind::box, FilterKind::gaussian, FilterKind::mitchell}) {
        scene.film.filter.kind = kind;
        Image image = render_quietly(scene).image;
        for (const char* color : {"R", "G", "B"})
            for (std::size_t i = 0; i < image.pixel_count(); i++) {
                double mean = channel(image, color)[i];
                double variance = channel(image, fmt::format("variance.{}", color))[i];
                CHECK(variance <= (kind == FilterKind::box ? 0 : 1e-13 * mean * mean));
            }
    }
}

TEST_CASE("One sample has no variance: asking for it is refused", "[render]") {
    Scene scene = scene_of(boxed, 1);
    CHECK_THROWS_WITH(render_quietly(scene),
                      Catch::Contains("variance") && Catch::Contains("2 samples"));
}
