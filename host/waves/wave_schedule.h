// Which wave comes next: all blocks for some samples, then for the next ones; streams take turns.
#pragma once

#include "host/waves/wave.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

namespace parhelion {

/// What a wave may hold at most.
struct WaveLimits {
    int samples = 1;       ///< of a block
    int band_blocks = 1;   ///< the film comes in bands of so many blocks, a wave lies in one
    int block_samples = 1; ///< blocks times samples
};

/// Hands out the waves of a render to several threads. No two that are under way have a block in
/// common, so that each has its tiles of the film alone.
class WaveSchedule {
public:
    WaveSchedule(const SampleSet& todo, const WaveLimits& limits);

    /// None: nothing is left, or it was stopped.
    std::optional<Wave> take();
    /// A wave that was taken is on the film; the longest of its launches took so many seconds, 0
    /// where that is not known. Later waves are as large as that allows (wave_pace.h).
    void finish(const Wave& wave, double longest_launch = 0);
    /// No more waves, and nobody waits any longer.
    void stop();
    /// After a stop, once all waves that were taken are finished.
    void go_on() { stopped_ = false; }

    /// What is on the film, when no wave is under way.
    const SampleSet& done() const { return done_; }
    /// Samples that are not on the film, of a pixel of a block each.
    std::int64_t left() const { return left_; }

private:
    bool is_free(const SampleRange& range, const Wave& taken) const;
    SampleRange take_piece(int samples, int blocks);
    Wave next_wave();

    WaveLimits limits_;
    int limit_; ///< of the next wave, blocks times samples
    std::deque<SampleRange> todo_;
    std::vector<Wave> under_way_;
    SampleSet done_;
    std::atomic<std::int64_t> left_ = 0;
    bool stopped_ = false;
    std::mutex mutex_;
    std::condition_variable changed_;
};

} // namespace parhelion
