// Three ways to divide a range of references in two.
#pragma once

#include "host/bvh/bounds.h"

#include <cstddef>
#include <span>

namespace parhelion {

/// A range longer than this is worked on by several threads.
inline constexpr std::size_t parallel_range = 1 << 15;

/// The box around all references.
Box range_box(std::span<const Reference> range);

/// Are all references of one geometry kind?
bool one_kind(std::span<const Reference> range);

// Each of these reorders the range (at least two references) so that its first part belongs to the
// one child and the rest to the other, and returns the length of the first part, which is neither 0
// nor all. The order is the same for any number of threads.

/// Binned surface area heuristic, 32 bins along each axis (Wald 2007, "On fast construction of
/// SAH-based bounding volume hierarchies"); halves the range where bins cannot tell the references
/// apart. `scratch` has the range's length.
std::size_t split_by_surface_area(std::span<Reference> range, std::span<Reference> scratch);

/// Halves the range along the longest axis of the centres; references with one centre are taken by
/// number.
std::size_t split_in_half(std::span<Reference> range);

/// Those of the lowest kind present, and the others; there is more than one kind.
std::size_t split_by_kind(std::span<Reference> range);

} // namespace parhelion
