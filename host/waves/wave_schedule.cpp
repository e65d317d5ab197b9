// Which wave comes next: all blocks for some samples, then for the next ones; streams take turns.
#include "host/waves/wave_schedule.h"

#include <algorithm>

namespace parhelion {

WaveSchedule::WaveSchedule(int blocks, int samples, int blocks_per_wave, int samples_per_wave)
    : blocks_(blocks), samples_(samples), blocks_per_wave_(blocks_per_wave),
      samples_per_wave_(samples_per_wave), done_((blocks + blocks_per_wave - 1) / blocks_per_wave) {
}

std::optional<WaveParams> WaveSchedule::take() {
    std::unique_lock lock(mutex_);
    if (next_sample_ >= samples_) return std::nullopt;
    WaveParams wave{next_block_, std::min(blocks_per_wave_, blocks_ - next_block_), next_sample_,
                    std::min(samples_per_wave_, samples_ - next_sample_)};
    next_block_ += wave.block_count;
    if (next_block_ == blocks_) next_block_ = 0, next_sample_ += wave.sample_count;
    const int& done = done_[wave.first_block / blocks_per_wave_];
    changed_.wait(lock, [&] { return done >= wave.first_sample; });
    if (done > wave.first_sample) return std::nullopt; // given up
    return wave;
}

double WaveSchedule::finish(const WaveParams& wave) {
    std::scoped_lock lock(mutex_);
    done_[wave.first_block / blocks_per_wave_] += wave.sample_count;
    total_done_ += static_cast<double>(wave.block_count) * wave.sample_count;
    changed_.notify_all();
    return total_done_ / (static_cast<double>(blocks_) * samples_);
}

void WaveSchedule::give_up() {
    std::scoped_lock lock(mutex_);
    next_sample_ = samples_;
    std::fill(done_.begin(), done_.end(), samples_);
    changed_.notify_all();
}

} // namespace parhelion
