// Three ways to divide a range of references in two.
#pragma once

#include "host/bvh/bounds.h"

#include <array>
#include <cstddef>
#include <span>

namespace parhelion {

/// A range longer than this is worked on by several threads.
inline constexpr std::size_t parallel_range = 1 << 15;

/// What a division needs to know of a range of references.
struct RangeBounds {
    Box box;     ///< around the references
    Box centres; ///< around their half_centre()
};

RangeBounds range_bounds(std::span<const Reference> range);

/// Are all references of one geometry kind?
bool one_kind(std::span<const Reference> range);

/// The first part of a range and the rest; neither is empty.
struct Division {
    std::size_t first_count = 0; ///< 0: not divided
    std::array<RangeBounds, 2> bounds;
};

// Each of these takes at least two references. The order within the parts is the same for any
// number of threads.

/// Binned surface area heuristic (Wald 2007, "On fast construction of SAH-based bounding volume
/// hierarchies"). Writes the parts to `target`, which has the range's length; where bins cannot
/// tell the references apart it writes nothing and divides nothing.
Division split_by_surface_area(std::span<const Reference> range, const RangeBounds& bounds,
                               std::span<Reference> target);

/// Halves the range in place, along the longest axis of the centres; references with one centre are
/// taken by number.
Division split_in_half(std::span<Reference> range, const RangeBounds& bounds);

/// Those of the lowest kind present, and the others, in place; there is more than one kind.
Division split_by_kind(std::span<Reference> range);

} // namespace parhelion
