// The per-pixel z-test and the z-test of the mean.
#include "host/image/z_test.h"

#include "host/image/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace parhelion {

namespace {

void check_lengths(const std::vector<TestedChannel>& channels) {
    if (channels.empty()) throw std::invalid_argument("z-test: no channels");
    const std::size_t count = channels[0].image.size();
    for (const TestedChannel& channel : channels)
        if (count == 0 || channel.image.size() != count || channel.reference.size() != count ||
            channel.variance.size() != count)
            throw std::invalid_argument("z-test: channels of different lengths");
}

/// Level of each of n independent tests such that one of them fails with probability alpha.
double sidak(double alpha, double n) { return -std::expm1(std::log1p(-alpha) / n); }

/// Variance of the difference image - reference, over the variance of one sample.
double variance_scale(const ZTestOptions& options) {
    const double of_reference = options.reference_samples ? 1.0 / *options.reference_samples : 0.0;
    return 1.0 / options.samples + of_reference;
}

PixelTest test_pixels(const std::vector<TestedChannel>& channels, int width,
                      const ZTestOptions& options) {
    PixelTest test;
    test.alpha = sidak(options.alpha, static_cast<double>(channels[0].image.size()));
    const double scale = variance_scale(options);
    for (const TestedChannel& channel : channels) {
        for (std::size_t i = 0; i < channel.image.size(); ++i) {
            const double variance = std::max(channel.variance[i], options.variance_floor) * scale;
            const double difference = std::abs(channel.image[i] - channel.reference[i]);
            const double z = difference == 0.0 ? 0.0 : difference / std::sqrt(variance);
            ++test.values;
            test.passed += two_sided_p(z) > test.alpha;
            if (z > test.largest.value || test.largest.channel.empty()) {
                const auto columns = static_cast<std::size_t>(width);
                test.largest = {z, channel.name, static_cast<int>(i % columns),
                                static_cast<int>(i / columns)};
            }
        }
    }
    return test;
}

MeanTest test_mean(const TestedChannel& channel, const ZTestOptions& options) {
    double difference = 0.0, variance = 0.0;
    for (std::size_t i = 0; i < channel.image.size(); ++i) {
        difference += channel.image[i] - channel.reference[i];
        variance += channel.variance[i];
    }
    if (variance < 0.0) throw std::invalid_argument("z-test: the variance is negative");
    const double count = static_cast<double>(channel.image.size());
    MeanTest test;
    test.channel = channel.name;
    test.difference = difference / count;
    test.standard_error = std::sqrt(variance * variance_scale(options)) / count;
    // Without noise every difference is significant: z is infinite and p zero.
    test.z = test.difference == 0.0 ? 0.0 : test.difference / test.standard_error;
    test.p = two_sided_p(test.z);
    return test;
}

} // namespace

double two_sided_p(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

void undo_xyz_statistics(std::vector<TestedChannel>& channels) {
    const std::array<const char*, 3> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"};
    check_lengths(channels);
    if (channels.size() != 3) throw std::invalid_argument("z-test: XYZ statistics need R, G, B");
    for (int c = 0; c < 3; ++c)
        if (channels[c].name != rgb[c])
            throw std::invalid_argument("z-test: XYZ statistics need R, G, B");
    static const Matrix3 to_xyz = inverse(xyz_to_srgb);
    for (const auto plane :
         {&TestedChannel::image, &TestedChannel::reference, &TestedChannel::variance}) {
        for (std::size_t i = 0; i < channels[0].image.size(); ++i) {
            const std::array<double, 3> value =
                transform(to_xyz, {(channels[0].*plane)[i], (channels[1].*plane)[i],
                                   (channels[2].*plane)[i]});
            for (int c = 0; c < 3; ++c)
                (channels[c].*plane)[i] = value[c];
        }
    }
    for (int c = 0; c < 3; ++c)
        channels[c].name = xyz[c];
}

ZTest run_z_test(const std::vector<TestedChannel>& channels, int width,
                 const ZTestOptions& options) {
    check_lengths(channels);
    ZTest test;
    test.pixels = test_pixels(channels, width, options);
    test.pixels_pass = test.pixels.fraction() >= options.required_fraction;
    test.mean_alpha = sidak(options.alpha, static_cast<double>(channels.size()));
    test.means_pass = true;
    for (const TestedChannel& channel : channels) {
        test.means.push_back(test_mean(channel, options));
        test.means_pass = test.means_pass && test.means.back().p > test.mean_alpha;
    }
    return test;
}

} // namespace parhelion
