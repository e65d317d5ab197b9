// How the work of a render is split, and how large its buffers are.
#pragma once

#include "host/film/film_layout.h"
#include "host/waves/wave_schedule.h"

#include <cstddef>
#include <vector>

namespace parhelion {

/// How work is split. None of these changes a bit of the image.
struct WorkSplit {
    int pool_paths = 1 << 16; ///< paths in flight: the memory of a render, whatever its resolution
    int segment_paths = 2048; ///< paths one work-item owns; made a multiple of 16
    int work_group_size = 1;
    int streams = 0; ///< waves under way at once, which share the pool; 0: what suits the device
    std::size_t film_bytes = 0; ///< of a band of the film; 0: what suits the device
    bool bands_in_turn = false; ///< one band of the film at a time is in memory
};

/// Sizes that follow from film, samples and split, of one stream.
struct WorkSizes {
    int streams = 1;
    int samples_per_wave = 1, blocks_per_wave = 1, path_capacity = 16;
    int segments = 1, segment_size = 16, segment_stride = 32;
    int segment_unit = 1; ///< that sizes of segments are multiples of: what is handled at once
    int work_group_size = 1;
    FilmLayout film;
    int bands_at_once = 1; ///< of the film, in memory

    /// Floats from one channel of the results, or word of a state, to the next.
    std::size_t result_stride() const { return odd_lines(path_capacity); }
    std::size_t state_stride() const {
        return odd_lines(static_cast<std::size_t>(segments) * segment_stride);
    }
    /// Of a wave, of one sample each.
    int block_capacity() const { return path_capacity / BLOCK_PIXELS; }
    /// Of the segments' size what a wave of `paths` uses: each segment has as many of them, so that
    /// fewer paths take less time also where a work-item of each is under way at once.
    int used_segment_size(int paths) const;
    WaveLimits wave_limits() const {
        return {samples_per_wave, film.band_blocks, block_capacity()};
    }
};

/// `split.streams` must be chosen. Throws InputError for more paths than a device counts.
WorkSizes work_sizes(const FilmLayout& film, int samples, int lanes, const WorkSplit& split);

/// Those of the pool that is asked for, then of the half of it and so on, down to one group of
/// samples of a block a stream: what a device has room for is one of them. At least one.
std::vector<WorkSizes> pool_choices(const FilmLayout& film, int samples, int lanes,
                                    WorkSplit split);

#define BUFFER_COUNT(type, name) std::size_t name;
/// Elements of the work buffers: those of one stream, and a band of the film, which all streams
/// share.
struct BufferCounts {
    WORK_BUFFERS(BUFFER_COUNT)
};
#undef BUFFER_COUNT

BufferCounts buffer_counts(const WorkSizes& sizes);

/// What all streams take beside the film, whatever its resolution, bytes.
std::size_t pool_bytes(const WorkSizes& sizes);

} // namespace parhelion
