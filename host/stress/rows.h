// The rows of the catalogue that are no plain test of one function.
#pragma once

#include "host/stress/stress_run.h"

namespace parhelion::stress {

// name, chapter, title
// clang-format off
#define STRESS_ROWS(X)                                                                             \
    X(one_argument,      "Functions", "Functions of one number, at every float of their domain")   \
    X(same_bits,         "Functions", "Host and device compute the same bits, every shared function on wild inputs") \
    X(leaks,             "Rays", "Rays at edges and corners of closed meshes never get out")       \
    X(self_hits,         "Rays", "Rays that leave a triangle do not hit it again")
// clang-format on

#define DECLARE_ROW(name, chapter, title) Checks row_##name(StressRun& run);
STRESS_ROWS(DECLARE_ROW)

} // namespace parhelion::stress
