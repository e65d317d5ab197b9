// Which wave comes next: all blocks for some samples, then for the next ones; streams take turns.
#include "host/waves/wave_schedule.h"

#include "host/waves/wave_pace.h"

#include <algorithm>

namespace parhelion {
namespace {

bool share_blocks(const SampleRange& a, const SampleRange& b) {
    return a.first_block < b.end_block && b.first_block < a.end_block;
}

bool share_blocks(const SampleRange& range, const Wave& wave) {
    return std::any_of(wave.ranges.begin(), wave.ranges.end(),
                       [&](const SampleRange& other) { return share_blocks(range, other); });
}

} // namespace

WaveSchedule::WaveSchedule(const SampleSet& todo, const WaveLimits& limits)
    : limits_(limits), limit_(first_wave_limit(limits.block_samples)),
      todo_(todo.begin(), todo.end()), left_(sample_count(todo)) {}

bool WaveSchedule::is_free(const SampleRange& range, const Wave& taken) const {
    return !share_blocks(range, taken) &&
           std::none_of(under_way_.begin(), under_way_.end(),
                        [&](const Wave& wave) { return share_blocks(range, wave); });
}

/// The first `samples` of the first blocks, `blocks` of them at most, of what comes next. Further
/// samples of the same blocks come after all else.
SampleRange WaveSchedule::take_piece(int samples, int blocks) {
    SampleRange& next = todo_.front();
    SampleRange piece = next;
    piece.end = piece.first + samples;
    piece.end_block = next.first_block = std::min(next.end_block, next.first_block + blocks);
    SampleRange later{piece.first_block, piece.end_block, piece.end, next.end};
    if (next.first_block == next.end_block) todo_.pop_front();
    if (later.first == later.end) return piece;
    if (!todo_.empty() && todo_.back().end_block == later.first_block &&
        todo_.back().first == later.first && todo_.back().end == later.end)
        todo_.back().end_block = later.end_block;
    else
        todo_.push_back(later);
    return piece;
}

/// Empty where what comes next has to wait.
Wave WaveSchedule::next_wave() {
    // What is added up together must be in one wave.
    const int most_samples =
        std::min(limits_.samples, std::max(FILM_SAMPLES, limit_ / FILM_SAMPLES * FILM_SAMPLES));
    Wave wave;
    int room = 0;
    while (!todo_.empty()) {
        const SampleRange& next = todo_.front();
        const int samples = std::min(most_samples, next.end - next.first);
        const int band = next.first_block / limits_.band_blocks;
        if (wave.ranges.empty()) {
            wave.band = band;
            room = std::max(1, limit_ / samples);
        } else if (room == 0 || samples != wave.samples() || band != wave.band) {
            break;
        }
        const int in_band = (band + 1) * limits_.band_blocks - next.first_block;
        SampleRange piece = next;
        piece.end_block = std::min(next.end_block, next.first_block + std::min(room, in_band));
        if (!is_free(piece, wave)) break;
        wave.ranges.push_back(take_piece(samples, piece.end_block - piece.first_block));
        room -= piece.end_block - piece.first_block;
    }
    return wave;
}

std::optional<Wave> WaveSchedule::take() {
    std::unique_lock lock(mutex_);
    while (!stopped_ && !todo_.empty()) {
        Wave wave = next_wave();
        if (!wave.ranges.empty()) {
            under_way_.push_back(wave);
            return wave;
        }
        changed_.wait(lock);
    }
    return std::nullopt;
}

void WaveSchedule::finish(const Wave& wave, double longest_launch) {
    std::scoped_lock lock(mutex_);
    limit_ = next_wave_limit(limit_, limits_.block_samples, wave.blocks() * wave.samples(),
                             longest_launch);
    done_ = done_ | wave.ranges;
    left_ -= sample_count(wave.ranges);
    under_way_.erase(std::find_if(under_way_.begin(), under_way_.end(),
                                  [&](const Wave& other) { return other.ranges == wave.ranges; }));
    changed_.notify_all();
}

void WaveSchedule::stop() {
    std::scoped_lock lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
}

} // namespace parhelion
