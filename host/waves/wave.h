// A wave: samples of some blocks that go through the stages together.
#pragma once

#include "host/film/sample_set.h"
#include "kernels/device/buffers.h"

#include <vector>

namespace parhelion {

struct Wave {
    std::vector<SampleRange> ranges; ///< of as many samples each; no two of them share a block
    int band = 0;                    ///< of the film that has all their blocks

    int samples() const { return ranges.empty() ? 0 : ranges[0].end - ranges[0].first; }
    int blocks() const {
        int count = 0;
        for (const SampleRange& range : ranges)
            count += range.end_block - range.first_block;
        return count;
    }
};

/// As kernels are told them.
inline std::vector<WaveBlock> wave_blocks(const Wave& wave) {
    std::vector<WaveBlock> blocks;
    blocks.reserve(static_cast<std::size_t>(wave.blocks()));
    for (const SampleRange& range : wave.ranges)
        for (int block = range.first_block; block < range.end_block; block++)
            blocks.push_back({block, range.first});
    return blocks;
}

/// `band_blocks`: of each band of the film.
inline WaveParams wave_params(const Wave& wave, int band_blocks) {
    return {wave.blocks(), wave.samples(), wave.band * band_blocks, 0};
}

} // namespace parhelion
