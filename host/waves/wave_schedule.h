// Which wave comes next: all blocks for some samples, then for the next ones; streams take turns.
#pragma once

#include "kernels/shared/types.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

namespace parhelion {

/// Hands out the waves of a render to several threads. The samples of a block are added up in their
/// order: a wave waits for the one before it of the same blocks.
class WaveSchedule {
public:
    WaveSchedule(int blocks, int samples, int blocks_per_wave, int samples_per_wave);

    /// None: nothing is left, or the render was given up.
    std::optional<WaveParams> take();
    /// A wave that was taken is on the film. Returns the share of all samples that are, 0 to 1.
    double finish(const WaveParams& wave);
    /// No more waves, and nobody waits any longer.
    void give_up();

private:
    int blocks_, samples_, blocks_per_wave_, samples_per_wave_;
    int next_block_ = 0, next_sample_ = 0;
    std::vector<int> done_; ///< samples on the film, for each group of blocks
    double total_done_ = 0;
    std::mutex mutex_;
    std::condition_variable changed_;
};

} // namespace parhelion
