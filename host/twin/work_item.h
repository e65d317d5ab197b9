// A work-item on the host: what OpenCL gives the kernels, as members.
#pragma once

#include "host/feature_set.h"

#include <sys/types.h> // uint, ulong

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace parhelion {

using uchar = unsigned char; // NOLINT(readability-identifier-naming): OpenCL's

/// A buffer of the kernels.
struct BufferRange {
    const char* name = "";
    std::uintptr_t begin = 0, bytes = 0;

    bool holds(std::uintptr_t at, std::size_t count) const {
        return at - begin <= bytes && bytes - (at - begin) >= count;
    }
};

struct WorkItem {
    FeatureSet features; ///< what HAS() asks
    int number = 0;
    std::span<const BufferRange> buffers{}; ///< that may be touched; empty: whatever it is given
    const BufferRange* last = nullptr;      ///< that was

    /// `at` where it is in the same buffer as `base`. Throws std::logic_error where not.
    void* inside(const void* base, const void* at, std::size_t bytes) {
        auto begin = reinterpret_cast<std::uintptr_t>(at),
             from = reinterpret_cast<std::uintptr_t>(base);
        bool known = last && last->holds(begin, bytes) && last->holds(from, 0);
        if (!known && !buffers.empty()) last = &buffer_with(from, begin, bytes);
        return const_cast<void*>(at);
    }
    const BufferRange& buffer_with(std::uintptr_t base, std::uintptr_t at, std::size_t bytes) const;

    int get_global_id(uint) const { return number; }
    static int popcount(uint x) { return std::popcount(x); }
    static int lowest_bit(uint x) { return std::countr_zero(x); }
    static int min(int a, int b) { return std::min(a, b); }
    static float as_float(int x) { return std::bit_cast<float>(x); }
};

} // namespace parhelion
