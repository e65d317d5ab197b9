// Which samples of which blocks: of a film those that are on it, of a render those that are left.
#pragma once

#include <cstdint>
#include <vector>

namespace parhelion {

/// Samples [first, end) of each of the blocks [first_block, end_block) of the sampled window.
struct SampleRange {
    int first_block = 0, end_block = 0, first = 0, end = 0;

    std::int64_t count() const {
        return static_cast<std::int64_t>(end_block - first_block) * (end - first);
    }
    bool operator==(const SampleRange&) const = default;
};

/// Ranges without a sample in common, none of them empty, by blocks and then by samples; those of
/// one set of samples are the same however it has come about.
using SampleSet = std::vector<SampleRange>;

/// Of a block each, those of all blocks together. Samples are of a pixel: a block has 16 times as
/// many.
std::int64_t sample_count(const SampleSet& set);

SampleSet all_samples(int blocks, int samples);

SampleSet operator|(const SampleSet& a, const SampleSet& b);
SampleSet operator&(const SampleSet& a, const SampleSet& b);
SampleSet operator-(const SampleSet& a, const SampleSet& b);

/// How many each of the blocks [0, blocks) has at least.
int fewest_samples(const SampleSet& set, int blocks);

/// Those whose numbers are in [first, end).
SampleSet samples_between(const SampleSet& set, int first, int end);
/// Those of the blocks [first, end).
SampleSet blocks_between(const SampleSet& set, int first, int end);

} // namespace parhelion
