// Domains of the numbers that only the command line of a render can give.
#pragma once

#include "host/scene/limits.h"
#include "kernels/shared/types.h"

namespace parhelion {

/// Offsets, then sides, which must lie inside the film.
inline constexpr Domain crop_domain = whole_number(0, 65536).in("pixels");
/// The border that a filter reaches is negative, or behind the film.
inline constexpr Domain pixel_domain =
    whole_number(-FILTER_REACH_LIMIT, 65535 + FILTER_REACH_LIMIT);
inline constexpr Domain sensor_domain = whole_number(0, largest_int);
inline constexpr Domain sample_domain = whole_number(0, largest_int - 1);
/// From the least to the largest value that an image can hold, to white.
inline constexpr Domain exposure_domain = between(-128, 128).in("stops");
/// More than that is more than any machine has a use for, and threads have a memory of their own.
inline constexpr Domain threads_domain = whole_number(0, 1024);
/// Powers of two: samples take turns by the last bits of their number.
inline constexpr Domain replicates_domain{
    .lowest = 1, .highest = 8, .whole = true, .only = {1, 2, 4, 8}, .only_count = 4};
/// As the conventions of Cryptomatte number their channels, two ranks each.
inline constexpr Domain cryptomatte_depth_domain = whole_number(1, 64);

// Buffers of the largest pool have a few GB; their elements are counted in int.
inline constexpr Domain pool_paths_domain = whole_number(BLOCK_PIXELS, 1 << 26);
inline constexpr Domain segment_paths_domain = whole_number(1, 1 << 20);
/// A stream has a thread of its own.
inline constexpr Domain streams_domain = whole_number(0, 256);
inline constexpr Domain work_group_domain = whole_number(1, 65536);
inline constexpr Domain lanes_domain{
    .lowest = 0, .highest = 16, .whole = true, .only = {0, 1, 8, 16}, .only_count = 4};

} // namespace parhelion
