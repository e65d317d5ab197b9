// Everything `parhelion compare` measures between two images, as values.
#pragma once

#include "host/image/flip.h"
#include "host/image/image.h"
#include "host/image/metrics.h"
#include "host/image/other_channels.h"
#include "host/image/z_test.h"

#include <optional>
#include <string>
#include <vector>

namespace parhelion {

/// An image and how to call it in messages.
struct NamedImage {
    std::string name;
    const Image& image;
};

struct VarianceInput {
    NamedImage image;            ///< variance of one sample of each pixel, channels as compared
    bool xyz_statistics = false; ///< R, G, B of all images hold XYZ through the linear matrix
    ZTestOptions test;
};

struct ComparisonOptions {
    std::string layer;     ///< "" is the main layer
    double epsilon = 0.01; ///< of relMSE
    double pixels_per_degree = flip_default_pixels_per_degree;
    std::vector<std::string> left_out_layers{}; ///< of which nothing is compared
};

struct FlipFigures {
    double mean = 0.0, largest = 0.0; ///< 0 the same, 1 as different as can be
    std::vector<double> of_pixels;    ///< row-major
};

struct Comparison {
    int width = 0, height = 0;
    std::vector<std::string> channels; ///< that the figures are of
    NonFinite non_finite;              ///< in those
    bool equal = false;                ///< every value of those the same (NaN equals NaN)
    OtherChannels others;              ///< all that the images hold beside those
    bool identical() const { return equal && others.all_equal() && others.none_missing(); }
    Metrics metrics;
    std::optional<FlipFigures> flip; ///< absent without R, G, B, or where a value is not finite
    std::optional<ZTest> z_test;
    std::size_t negative_variances = 0; ///< rounding in the variance file; kept as they are
};

/// Throws InputError for images of other sizes or windows.
void check_windows(const NamedImage& a, const NamedImage& b);

/// The channels of one layer that both images have: R, G, B and A where there is any of R, G, B in
/// the main layer (a depth beside them is another thing), else all.
std::vector<ChannelPair> common_channels(const Image& image, const Image& reference,
                                         const std::string& layer);

/// Throws InputError for images that cannot be compared: other sizes or windows, no common
/// channels, values not finite that are not the same in both.
Comparison compare_images(const NamedImage& image, const NamedImage& reference,
                          const ComparisonOptions& options,
                          const std::optional<VarianceInput>& variance = std::nullopt);

} // namespace parhelion
