// What images say themselves of how far off they may be.
#pragma once

#include "host/image/comparison.h"

#include <array>

namespace parhelion {

/// What `compare --variance` takes in place of a file.
inline constexpr const char* own_variance = "own";

/// The layers that it takes.
inline constexpr std::array own_variance_layers{"variance", "samples"};

/// The variance of image - reference in each pixel, named as the channels it is of: R, G and B of
/// the layer `variance` (that of one sample) over samples.N, of the image, and of the reference
/// where it has these layers; otherwise the reference is exact. Throws InputError for an image
/// without them, or of other windows.
Image variance_of_difference(const NamedImage& image, const NamedImage& reference);

/// Whether an image has the layers that variance_of_difference takes.
bool has_own_variance(const Image& image);

/// `options` for a z-test with such variances; its floor is still of one sample.
ZTestOptions own_variance_test(ZTestOptions options, const Image& image);

} // namespace parhelion
