// How much of each pixel every shape covers, as the camera's rays meet them: sums of the
// reconstruction filter's weights, by shape.
//
// A weight is rounded to a multiple of 2^-28 by itself, and integers are added: sums are the same
// in any order, however the samples have been shared out.
#pragma once

#include <cstdint>
#include <vector>

namespace parhelion {

inline constexpr double coverage_unit = 0x1p-28;
inline constexpr int no_shape = -1; ///< of rays that meet nothing

/// What samples that have met a shape weigh in a pixel, in coverage_unit.
struct ShapeWeight {
    std::int32_t place = 0; ///< of the pixel: x in a row of a crop, or the cell of a tile
    std::int32_t shape = no_shape;
    std::int64_t weight = 0;

    bool operator==(const ShapeWeight&) const = default;
};

using ShapeWeights = std::vector<ShapeWeight>;

/// Adds up what is of one place and shape, and sorts it by them.
void add_up(ShapeWeights& weights);

} // namespace parhelion
