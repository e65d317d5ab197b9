// References counted and enclosed by bins along the three axes, and the cheapest plane between
// bins.
#pragma once

#include "host/bvh/bounds.h"

#include <array>
#include <cstddef>
#include <limits>
#include <span>

namespace parhelion {

inline constexpr int bin_count = 32;
inline constexpr float last_position = bin_count - 1;

using Int4 = int __attribute__((vector_size(16)));

/// Maps centres to bins along all axes at once.
struct BinGrid {
    Float4 origin, scale;

    /// `centres` is the box around the half centres of the references.
    explicit BinGrid(const Box& centres)
        : origin(centres.low), scale(float(bin_count) / (centres.high - centres.low)) {}

    /// Where the scale is infinite (no extent, or one too small to divide by) everything falls into
    /// the last bin.
    Int4 bin_of(const Reference& reference) const {
        Float4 position = (half_centre(reference) - origin) * scale;
        return __builtin_convertvector(minimum(position, Float4{} + last_position), Int4);
    }
};

struct Bins {
    std::array<std::array<Box, bin_count>, 3> boxes;
    std::array<std::array<int, bin_count>, 3> counts;
};

Bins empty_bins();
void fill(Bins& bins, std::span<const Reference> range, const BinGrid& grid);
/// Adds the references of `later`, which come after those of `bins`.
void join(Bins& bins, const Bins& later);

/// References in bins up to `last_bin` along `axis` go to the first part; no axis: bins cannot tell
/// them apart.
struct BinPlane {
    int axis = -1, last_bin = 0;
    double cost = std::numeric_limits<double>::infinity();
    int imbalance = 0;
};

/// The plane of least surface area heuristic; of equally cheap ones the most balanced.
BinPlane best_plane(const Bins& bins);

/// References in the first part.
int first_part(const Bins& bins, const BinPlane& plane);
/// Boxes of the two parts.
std::array<Box, 2> part_boxes(const Bins& bins, const BinPlane& plane);

} // namespace parhelion
