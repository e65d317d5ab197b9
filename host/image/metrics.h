// Differences between an image and its reference, in double precision.
#pragma once

#include "host/image/image.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace parhelion {

/// The same channel of the image and of the reference.
struct ChannelPair {
    std::string name;
    std::span<const float> image, reference;
};

/// Errors of one channel, or of all together; the unit is the images' own (radiance), but squared
/// and relative figures say so. The bias of `relmse` comes from the epsilon it is made with.
struct ErrorFigures {
    double rmse = 0.0;           ///< root of the mean of (I - R)^2
    double relmse = 0.0;         ///< mean of (I - R)^2 / (R^2 + epsilon)
    double mae = 0.0;            ///< mean of |I - R|
    double mean_image = 0.0;     ///< mean of I
    double mean_reference = 0.0; ///< mean of R

    double bias() const { return mean_image - mean_reference; }
    /// Bias over |mean of R|; infinite where that is zero and the bias is not.
    double relative_bias() const;
};

/// One value and where it stands (x to the right, y down, from the top left pixel stored).
struct LargestError {
    double value = 0.0; ///< |I - R|
    std::string channel;
    int x = 0, y = 0;
};

/// Values that are not finite. Those that are the same on both sides (the same infinity, or both
/// NaN) are equal and left out of every figure; any other makes the figures meaningless.
struct NonFinite {
    std::size_t in_image = 0, in_reference = 0;
    std::size_t equal = 0;        ///< values not finite and the same in both
    std::size_t different = 0;    ///< values not finite in one, or not the same in both
    LargestError first_different; ///< place of the first of those; `value` is unused
};

struct Metrics {
    double epsilon = 0.0; ///< of relmse, in squared units of the image
    std::vector<ErrorFigures> channels;
    ErrorFigures all; ///< over the values of all channels
    LargestError largest;
};

NonFinite count_non_finite(const std::vector<ChannelPair>& pairs, int width);

/// Throws std::invalid_argument for empty or unequal channels and where count_non_finite finds
/// values that differ.
Metrics compute_metrics(const std::vector<ChannelPair>& pairs, int width, double epsilon);

} // namespace parhelion
