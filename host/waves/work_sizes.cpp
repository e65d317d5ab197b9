// How the work of a render is split, and how large its buffers are.
#include "host/waves/work_sizes.h"

#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace parhelion {
namespace {

int rounded_up(int value, int unit) { return (value + unit - 1) / unit * unit; }

} // namespace

WorkSizes work_sizes(const FilmLayout& film, int samples, int lanes, const WorkSplit& split) {
    WorkSizes s;
    s.film = film;
    s.bands_at_once = split.bands_in_turn ? 1 : film.bands();
    s.streams = split.streams;
    s.work_group_size = split.work_group_size;
    // What is added up together must be in one wave.
    constexpr int together = FILM_SAMPLES;
    int groups = std::max(together, split.pool_paths / split.streams / BLOCK_PIXELS);
    // Few samples of many blocks, so that neighbouring pixels share a segment; more where the film
    // is too small to fill the pool.
    constexpr int usual = 16;
    // Every stream has blocks of its own.
    std::int64_t streams = split.streams;
    std::int64_t blocks = (static_cast<std::int64_t>(film.window.tiles()) + streams - 1) / streams;
    int to_fill = static_cast<int>(std::max<std::int64_t>(usual, groups / blocks));
    s.samples_per_wave = std::min(samples, std::min(to_fill, groups) / together * together);
    s.blocks_per_wave =
        static_cast<int>(std::min<std::int64_t>(groups / s.samples_per_wave, blocks));
    s.path_capacity = s.blocks_per_wave * s.samples_per_wave * BLOCK_PIXELS;
    s.segment_unit = lanes == 1 ? 1 : 16;
    s.segment_size = rounded_up(std::max(1, split.segment_paths), s.segment_unit);
    s.segment_size = std::min(s.segment_size, s.path_capacity);
    s.segment_stride = s.segment_size + (lanes == 1 ? 0 : SEGMENT_PADDING);
    s.segments =
        rounded_up((s.path_capacity + s.segment_size - 1) / s.segment_size, split.work_group_size);
    if (s.state_stride() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw InputError(
            fmt::format("{} segments of {} paths are more than the device counts (--pool-paths, "
                        "--segment-paths, --work-group-size; accepted: 2^31 paths together)",
                        s.segments, s.segment_size));
    return s;
}

int WorkSizes::used_segment_size(int paths) const {
    return std::min(segment_size, rounded_up((paths + segments - 1) / segments, segment_unit));
}

std::vector<WorkSizes> pool_choices(const FilmLayout& film, int samples, int lanes,
                                    WorkSplit split) {
    std::vector<WorkSizes> choices{work_sizes(film, samples, lanes, split)};
    for (; split.pool_paths > 1; split.pool_paths /= 2) {
        const WorkSizes s = work_sizes(film, samples, lanes, split);
        if (s.path_capacity < choices.back().path_capacity) choices.push_back(s);
    }
    return choices;
}

BufferCounts buffer_counts(const WorkSizes& s) {
    auto segments = static_cast<std::size_t>(s.segments);
    auto blocks = static_cast<std::size_t>(s.block_capacity());
    return {.path_state = path_word_count * s.state_stride(),
            .shadow_state = shadow_word_count * s.state_stride(),
            .results = static_cast<std::size_t>(s.film.result_channels()) * s.result_stride(),
            .wave_blocks = blocks,
            .counts = 2 * segments,
            // Of segments, and in accumulate of blocks.
            .statistics = statistic_count * std::max(segments, blocks),
            .bad_samples = bad_sample_field_count * s.film.window.tiles(),
            .film = s.film.words()};
}

std::size_t pool_bytes(const WorkSizes& sizes) {
    BufferCounts counts = buffer_counts(sizes);
    counts.bad_samples = 0;
#define ADD_BYTES(type, name) +counts.name * sizeof(type)
    return static_cast<std::size_t>(sizes.streams) * (0 WAVE_BUFFERS(ADD_BYTES));
#undef ADD_BYTES
}

} // namespace parhelion
