// Error figures against values worked out by hand, FLIP against its reference implementation, and
// the z-tests against synthetic images whose law is known.
#include "host/image/flip.h"
#include "host/image/metrics.h"
#include "host/image/srgb.h"
#include "host/image/z_test.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <random>

using namespace parhelion;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

struct RgbPlanes {
    std::array<std::vector<float>, 3> planes;

    LinearRgb view() const { return {planes[0], planes[1], planes[2]}; }
};

RgbPlanes constant(int pixels, float r, float g, float b) {
    const auto n = static_cast<std::size_t>(pixels);
    return {{std::vector<float>(n, r), std::vector<float>(n, g), std::vector<float>(n, b)}};
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

/// A picture of ramps and blocks, and a copy with a block inverted and single pixels white.
std::array<RgbPlanes, 2> flip_pair(int width, int height) {
    RgbPlanes reference = constant(width * height, 0, 0, 0), test = reference;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * width + x;
            const std::array<double, 3> value{(x * 7 + y * 3) % 256 / 255.0,
                                              (x * x + y * 5) % 200 / 255.0,
                                              (x / 6 + y / 4) % 2 * 180 / 255.0 + 20 / 255.0};
            const bool inverted = x >= 10 && x < 20 && y >= 5 && y < 15;
            const bool white = (x * 7 + y * 13) % 31 == 0;
            for (int c = 0; c < 3; ++c) {
                const auto v = static_cast<float>(value[c]);
                reference.planes[c][i] = v;
                test.planes[c][i] = white ? 1.0f : inverted && c == 1 ? 1.0f - v : v;
            }
        }
    }
    return {test, reference};
}

/// Image = reference + noise of the given law over `samples` samples a pixel.
std::vector<TestedChannel> noisy_channels(int pixels, double samples, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<TestedChannel> channels;
    for (const char* name : {"R", "G", "B"}) {
        TestedChannel channel{name, {}, {}, {}};
        for (int i = 0; i < pixels; ++i) {
            const double truth = 0.2 + i % 50 * 0.1, variance = 0.01 * (1 + i % 7) * truth;
            channel.reference.push_back(truth);
            channel.variance.push_back(variance);
            channel.image.push_back(truth + normal(random) * std::sqrt(variance / samples));
        }
        channels.push_back(channel);
    }
    return channels;
}

} // namespace

TEST_CASE("Metrics: figures worked out by hand") {
    const std::vector<float> a{1, 2, 3, 0}, b{1, 1, 5, 0}, c{2, 2, 2, 2}, d{2, 2, 2, -2};
    const Metrics m = compute_metrics({{"R", a, b}, {"G", c, d}}, 2, 0.5);
    CHECK(m.channels[0].rmse == Approx(std::sqrt(5.0 / 4.0)).epsilon(1e-15));
    CHECK(m.channels[0].relmse == Approx((1.0 / 1.5 + 4.0 / 25.5) / 4.0).epsilon(1e-15));
    CHECK(m.channels[0].mae == 0.75);
    CHECK(m.channels[0].mean_image == 1.5);
    CHECK(m.channels[0].mean_reference == 1.75);
    CHECK(m.channels[0].bias() == -0.25);
    CHECK(m.channels[0].relative_bias() == Approx(-1.0 / 7.0).epsilon(1e-15));
    CHECK(m.channels[1].rmse == 2.0);
    CHECK(m.channels[1].relative_bias() == 1.0);
    CHECK(m.all.rmse == Approx(std::sqrt(21.0 / 8.0)).epsilon(1e-15));
    CHECK(m.all.mae == Approx(7.0 / 8.0).epsilon(1e-15));
    CHECK(m.largest.value == 4.0);
    CHECK(m.largest.channel == "G");
    CHECK(m.largest.x == 1);
    CHECK(m.largest.y == 1);
}

TEST_CASE("Metrics: sums of floats do not lose what doubles keep") {
    const std::vector<float> a(1 << 20, 1000.25f), b(1 << 20, 1000.0f);
    const Metrics m = compute_metrics({{"R", a, b}}, 1024, 0.01);
    CHECK(m.all.rmse == 0.25);
    CHECK(m.all.bias() == 0.25);
    CHECK(m.largest.value == 0.25);
}

TEST_CASE("Metrics: equal images, black references, an epsilon of zero") {
    const std::vector<float> zero{0, 0}, one{1, 0};
    const Metrics same = compute_metrics({{"R", zero, zero}}, 2, 0.0);
    CHECK(same.all.rmse == 0.0);
    CHECK(same.all.relmse == 0.0);
    CHECK(same.all.relative_bias() == 0.0);
    CHECK(same.largest.value == 0.0);
    CHECK(same.largest.channel == "R");
    const Metrics black = compute_metrics({{"R", one, zero}}, 2, 0.0);
    CHECK(std::isinf(black.all.relmse));
    CHECK(black.all.relative_bias() == infinity);
}

TEST_CASE("Metrics: values that are not finite are counted, never averaged") {
    const std::vector<float> a{1, nan_value, infinity, 2}, b{1, nan_value, infinity, 4};
    const NonFinite equal = count_non_finite({{"R", a, b}}, 2);
    CHECK(equal.in_image == 2);
    CHECK(equal.in_reference == 2);
    CHECK(equal.equal == 2);
    CHECK(equal.different == 0);
    CHECK(compute_metrics({{"R", a, b}}, 2, 0.01).all.mae == 1.0); // of the two finite values

    const std::vector<float> c{1, nan_value, -infinity, 2};
    const std::vector<float> d{1, 3, infinity, 2};
    const NonFinite different = count_non_finite({{"R", c, d}}, 2);
    CHECK(different.in_image == 2);
    CHECK(different.in_reference == 1);
    CHECK(different.different == 2);
    CHECK(different.first_different.x == 1);
    CHECK(different.first_different.y == 0);
    CHECK_THROWS_AS(compute_metrics({{"R", c, d}}, 2, 0.01), std::invalid_argument);
}

TEST_CASE("FLIP: the figures of the reference implementation") {
    // flip-evaluator 1.7 (single precision) on the same pixels.
    const auto [test, reference] = flip_pair(40, 30);
    const std::vector<double> error = flip_error(test.view(), reference.view(), 40, 30);
    CHECK(mean(error) == Approx(0.1738592).margin(1e-6));
    CHECK(error[0] == Approx(0.9833022).margin(1e-5));
    CHECK(error[10 * 40 + 15] == Approx(0.8775033).margin(1e-5));
    CHECK(error[20 * 40 + 9] == Approx(0.1328556).margin(1e-5));
    CHECK(error[29 * 40 + 39] == Approx(0.0190459).margin(1e-5));
    CHECK(error[3 * 40 + 25] == Approx(0.0566245).margin(1e-5));
    const std::vector<double> far = flip_error(test.view(), reference.view(), 40, 30, 30.0);
    CHECK(mean(far) == Approx(0.1748625).margin(1e-6));
}

TEST_CASE("FLIP: black to white, green to blue, and the same") {
    const RgbPlanes black = constant(64, 0, 0, 0), white = constant(64, 1, 1, 1);
    CHECK(mean(flip_error(white.view(), black.view(), 8, 8)) == Approx(0.9673883).margin(1e-6));
    const RgbPlanes green = constant(64, 0, 1, 0), blue = constant(64, 0, 0, 1);
    CHECK(mean(flip_error(green.view(), blue.view(), 8, 8)) == Approx(1.0).margin(1e-9));
    const auto [test, reference] = flip_pair(17, 9);
    CHECK(mean(flip_error(test.view(), test.view(), 17, 9)) == 0.0);
    // What a screen cannot show makes no difference.
    const RgbPlanes bright = constant(64, 7, 20, 1.5f), dark = constant(64, -1, -2, 0);
    CHECK(mean(flip_error(bright.view(), white.view(), 8, 8)) == 0.0);
    CHECK(mean(flip_error(dark.view(), black.view(), 8, 8)) == 0.0);
}

TEST_CASE("FLIP: what cannot be judged is refused") {
    const RgbPlanes black = constant(4, 0, 0, 0);
    RgbPlanes broken = black;
    broken.planes[1][2] = nan_value;
    CHECK_THROWS_AS(flip_error(broken.view(), black.view(), 2, 2), std::invalid_argument);
    CHECK_THROWS_AS(flip_error(black.view(), black.view(), 3, 2), std::invalid_argument);
    CHECK_THROWS_AS(flip_error(black.view(), black.view(), 2, 2, 0.0), std::invalid_argument);
}

TEST_CASE("z-test: the normal law") {
    CHECK(two_sided_p(0.0) == 1.0);
    CHECK(two_sided_p(1.959963984540054) == Approx(0.05).epsilon(1e-12));
    CHECK(two_sided_p(-2.575829303548901) == Approx(0.01).epsilon(1e-12));
    CHECK(two_sided_p(10.0) == Approx(1.523970604832105e-23).epsilon(1e-10));
}

TEST_CASE("z-test: noise of the stated variance passes, for many seeds") {
    const int pixels = 4096;
    ZTestOptions options;
    options.samples = 100;
    int means_failed = 0;
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const ZTest test = run_z_test(noisy_channels(pixels, 100, seed), 64, options);
        CHECK(test.pixels_pass);
        CHECK(test.pixels.values == 3 * pixels);
        means_failed += !test.means_pass;
    }
    CHECK(means_failed <= 6); // 1 % expected of each seed; more than 6 of 100 has p < 1e-4
}

TEST_CASE("z-test: 5 sigma in 1 % of the pixels fails, a wrong variance fails") {
    const int pixels = 4096;
    ZTestOptions options;
    options.samples = 100;
    std::vector<TestedChannel> channels = noisy_channels(pixels, 100, 7);
    for (TestedChannel& channel : channels)
        for (int i = 0; i < pixels; i += 100) // both signs: the mean stays
            channel.image[i] = channel.reference[i] +
                               (i % 200 == 0 ? 5.0 : -5.0) * std::sqrt(channel.variance[i] / 100);
    const ZTest shifted = run_z_test(channels, 64, options);
    CHECK_FALSE(shifted.pixels_pass);
    CHECK(shifted.pixels.largest.value == Approx(5.0).epsilon(1e-9));
    CHECK(shifted.means_pass);

    options.samples = 400; // the noise is twice what this claims
    CHECK_FALSE(run_z_test(noisy_channels(pixels, 100, 7), 64, options).pixels_pass);
}

TEST_CASE("z-test: a small uniform bias passes the pixels and fails the mean") {
    ZTestOptions options;
    options.samples = 100;
    std::vector<TestedChannel> channels = noisy_channels(4096, 100, 11);
    CHECK(run_z_test(channels, 64, options).means_pass);
    for (double& value : channels[1].image)
        value *= 1.005;
    const ZTest test = run_z_test(channels, 64, options);
    CHECK(test.pixels_pass);
    CHECK_FALSE(test.means_pass);
    CHECK(test.means[0].p > test.mean_alpha);
    CHECK(test.means[1].p < 1e-4);
    CHECK(test.means[1].z > 4.0);
}

TEST_CASE("z-test: figures worked out by hand") {
    const std::vector<TestedChannel> channels{{"Y", {1.0, 2.0}, {1.0, 1.7}, {0.04, 0.09}}};
    ZTestOptions options;
    options.samples = 4;
    const ZTest exact = run_z_test(channels, 2, options);
    CHECK(exact.pixels.alpha == Approx(1.0 - std::sqrt(0.99)).epsilon(1e-12));
    CHECK(exact.mean_alpha == Approx(0.01).epsilon(1e-12));
    CHECK(exact.pixels.largest.value == Approx(0.3 / 0.15).epsilon(1e-12));
    CHECK(exact.pixels.largest.x == 1);
    CHECK(exact.means[0].difference == Approx(0.15).epsilon(1e-12));
    CHECK(exact.means[0].standard_error == Approx(std::sqrt(0.13 / 4.0) / 2.0).epsilon(1e-12));
    options.reference_samples = 4; // the difference has twice the variance
    const ZTest noisy = run_z_test(channels, 2, options);
    CHECK(noisy.means[0].z == Approx(exact.means[0].z / std::sqrt(2.0)).epsilon(1e-12));
    CHECK(noisy.pixels.largest.value == Approx(std::sqrt(2.0)).epsilon(1e-12));

    const ZTest silent = run_z_test({{"Y", {1.0, 1.5}, {1.0, 1.0}, {0.0, 0.0}}}, 2, options);
    CHECK(silent.pixels.largest.value == Approx(0.5 / std::sqrt(1e-4 / 2)).epsilon(1e-12));
    CHECK(silent.means[0].p == 0.0);
    CHECK_FALSE(silent.means_pass);
}

TEST_CASE("z-test: XYZ statistics come back from their RGB disguise") {
    const std::array<double, 3> truth{0.3, 0.5, 0.2}, spread{0.01, 0.02, 0.03};
    const auto disguised = transform(xyz_to_srgb, truth);
    const auto variance = transform(xyz_to_srgb, spread);
    CHECK(variance[0] < 0.0); // why it cannot be tested as it is
    std::vector<TestedChannel> channels;
    channels.reserve(3);
    for (int c = 0; c < 3; ++c)
        channels.push_back(
            {std::string(1, "RGB"[c]), {disguised[c]}, {disguised[c]}, {variance[c]}});
    undo_xyz_statistics(channels);
    for (int c = 0; c < 3; ++c) {
        CHECK(channels[c].name == std::string(1, "XYZ"[c]));
        CHECK(channels[c].image[0] == Approx(truth[c]).epsilon(1e-12));
        CHECK(channels[c].reference[0] == Approx(truth[c]).epsilon(1e-12));
        CHECK(channels[c].variance[0] == Approx(spread[c]).epsilon(1e-12));
    }
    std::vector<TestedChannel> two(channels.begin(), channels.begin() + 2);
    CHECK_THROWS_AS(undo_xyz_statistics(two), std::invalid_argument);
}
