// A work-item on the host: what OpenCL gives the kernels, as members.
#pragma once

#include <sys/types.h> // uint, ulong

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace parhelion {

using uchar = unsigned char; // NOLINT(readability-identifier-naming): OpenCL's

struct WorkItem {
    std::uint64_t features = 0; ///< what HAS() asks, a mask over enum Feature
    int number = 0;

    int get_global_id(uint) const { return number; }
    static int popcount(uint x) { return std::popcount(x); }
    static int lowest_bit(uint x) { return std::countr_zero(x); }
    static int min(int a, int b) { return std::min(a, b); }
    static float as_float(int x) { return std::bit_cast<float>(x); }
};

} // namespace parhelion
