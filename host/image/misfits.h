// What of an image a file does not hold as it is: counted where it is written, channel by channel.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parhelion {

/// The values of one channel that are no finite numbers, or that a file's format cannot hold.
struct Misfits {
    std::string channel;
    std::uint64_t not_finite = 0;   ///< in the image: infinite, or no number
    std::uint64_t out_of_range = 0; ///< finite, but beyond what the format holds
    int x = 0, y = 0;               ///< the first one, row by row: pixel of the full frame
    float value = 0.0f;             ///< what it is in the image

    std::uint64_t count() const { return not_finite + out_of_range; }
    /// Notes one, in the order of pixels.
    void add(int at_x, int at_y, float v, bool finite);
};

/// Values of all channels together.
std::uint64_t misfit_count(const std::vector<Misfits>& channels);

} // namespace parhelion
