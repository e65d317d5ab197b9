// Where two tracers disagree: ties at edges told apart from mistakes, by double precision.
#pragma once

#include "benchmarks/native/tracer.h"
#include "kernels/shared/types.h"

#include <cstddef>
#include <span>

namespace parhelion::bench {

struct Mismatches {
    std::size_t differ = 0; ///< rays with another primitive, or hit against miss
    std::size_t ties = 0;   ///< of these: within rounding of an edge or of both distances
    std::size_t ours_wrong = 0, theirs_wrong = 0; ///< the rest, as double precision judges
};

/// Compares two answers to the same rays; `any_hit` compares only whether there was a hit.
Mismatches count_mismatches(std::span<const PrimitiveRecord> primitives, std::span<const Ray> rays,
                            std::span<const Hit> ours, std::span<const Hit> theirs, bool any_hit);

} // namespace parhelion::bench
