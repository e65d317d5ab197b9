// Averaging images: a reference made of several renders.
#pragma once

#include <string>
#include <vector>

namespace parhelion::bench {

struct WeightedImage {
    std::string file;
    double weight; ///< its samples a pixel
};

/// Writes the weighted mean of images of one size and the same channels, summed in double. Throws
/// InputError where they are not.
void average_images(const std::vector<WeightedImage>& images, const std::string& output);

} // namespace parhelion::bench
