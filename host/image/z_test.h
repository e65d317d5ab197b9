// Statistical tests of a noisy image against a reference with known variance.
#pragma once

#include "host/image/image.h"
#include "host/image/metrics.h"

#include <optional>
#include <string>
#include <vector>

namespace parhelion {

/// What a test needs to know besides the images. The pixels are taken to be independent (a box
/// reconstruction filter) and the mean of N samples to be normal.
struct ZTestOptions {
    double samples = 1.0;                    ///< samples per pixel of the image
    std::optional<double> reference_samples; ///< of the reference; absent: the reference is exact
    double alpha = 0.01;               ///< chance of failing a right image; Sidak-corrected below
    double variance_floor = 1e-4;      ///< per-pixel test only; what Mitsuba 3 uses
    double required_fraction = 0.9975; ///< of the values; what Mitsuba 3 uses
};

struct PixelTest {
    std::size_t values = 0, passed = 0; ///< over all channels
    double alpha = 0.0;                 ///< per value: 1 - (1 - alpha)^(1/pixels)
    LargestError largest;               ///< the largest z and where

    double fraction() const { return static_cast<double>(passed) / static_cast<double>(values); }
};

struct MeanTest {
    std::string channel;
    double difference = 0.0;     ///< mean of I - R
    double standard_error = 0.0; ///< of that mean, from the variances as they are (no floor)
    double z = 0.0;              ///< difference / standard_error
    double p = 1.0;              ///< two-sided
};

struct ZTest {
    PixelTest pixels;
    std::vector<MeanTest> means; ///< one a channel
    double mean_alpha = 0.0;     ///< per channel: 1 - (1 - alpha)^(1/channels)
    bool pixels_pass = false, means_pass = false;
};

/// A channel ready for the tests; `variance` is that of one sample of the pixel.
struct TestedChannel {
    std::string name;
    std::vector<double> image, reference, variance;
};

/// Two-sided probability of |z| or more under the standard normal law.
double two_sided_p(double z);

/// Brings R, G, B holding XYZ through the linear matrix (srgb.h) back to X, Y, Z.
void undo_xyz_statistics(std::vector<TestedChannel>& channels);

/// Runs both tests. Throws std::invalid_argument for empty or unequal channels.
ZTest run_z_test(const std::vector<TestedChannel>& channels, int width,
                 const ZTestOptions& options);

} // namespace parhelion
