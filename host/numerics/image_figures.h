// What is compared of images: their means, and whether they are the same to the bit.
#pragma once

#include "host/image/image.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace parhelion::numerics {

using MeanRgb = std::array<double, 3>;

/// Mean of R, G, B over all pixels.
inline MeanRgb mean_rgb(const Image& image) {
    MeanRgb mean{};
    for (std::size_t c = 0; c < 3; c++) {
        for (float v : find_channel(image, std::string(1, "RGB"[c]))->values)
            mean[c] += v;
        mean[c] /= static_cast<double>(image.pixel_count());
    }
    return mean;
}

struct DifferingValues {
    std::uint64_t differing = 0, values = 0;
};

/// Values that differ, or are no numbers, in the window of `full` where `part` lies. Throws
/// std::runtime_error where they have other channels.
inline DifferingValues differing_values(const Image& full, const Image& part) {
    DifferingValues found;
    if (full.channels.size() != part.channels.size())
        throw std::runtime_error("the images have not as many channels");
    for (std::size_t c = 0; c < full.channels.size(); c++) {
        if (full.channels[c].name != part.channels[c].name)
            throw std::runtime_error("the images have other channels: " + full.channels[c].name +
                                     ", " + part.channels[c].name);
        for (int y = 0; y < part.height; y++)
            for (int x = 0; x < part.width; x++) {
                int fx = x + part.offset_x - full.offset_x, fy = y + part.offset_y - full.offset_y;
                float a = full.channels[c].values[full.index(fx, fy)];
                float b = part.channels[c].values[part.index(x, y)];
                found.values++;
                found.differing +=
                    std::bit_cast<unsigned>(a) != std::bit_cast<unsigned>(b) || !std::isfinite(a);
            }
    }
    return found;
}

} // namespace parhelion::numerics
