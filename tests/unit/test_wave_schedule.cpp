// Waves are handed out so that every sample comes once, and no two at a time have the same block.
#include "host/waves/wave_schedule.h"

#include <catch2/catch.hpp>

#include <array>
#include <map>
#include <thread>

using namespace parhelion;

namespace {

/// Of each block the samples that came, and how often.
using Seen = std::map<std::pair<int, int>, int>;

/// Runs all waves of a schedule in threads; whether two at a time shared a block.
bool run(WaveSchedule& schedule, int threads, Seen& seen, const WaveLimits& limits) {
    std::array<std::atomic<int>, 64> users{};
    std::atomic<bool> shared = false, too_large = false;
    std::mutex mutex;
    std::vector<std::jthread> running;
    running.reserve(threads);
    for (int t = 0; t < threads; t++)
        running.emplace_back([&] {
            while (auto wave = schedule.take()) {
                const auto blocks = wave_blocks(*wave);
                for (const WaveBlock& b : blocks)
                    if (users[b.block]++ > 0) shared = true;
                if (wave->blocks() * wave->samples() > std::max(limits.block_samples, 16) ||
                    wave->samples() > limits.samples)
                    too_large = true;
                std::this_thread::yield();
                {
                    std::scoped_lock lock(mutex);
                    for (const WaveBlock& b : blocks) {
                        if (b.block / limits.band_blocks != wave->band) too_large = true;
                        for (int s = 0; s < wave->samples(); s++)
                            seen[{b.block, b.first_sample + s}]++;
                    }
                }
                for (const WaveBlock& b : blocks)
                    users[b.block]--;
                schedule.finish(*wave);
            }
        });
    running.clear();
    return shared || too_large;
}

} // namespace

TEST_CASE("Wave schedule: every sample once, whatever there is to do") {
    const SampleSet sets[] = {all_samples(11, 37),
                              all_samples(1, 100),
                              {{0, 3, 16, 48}, {5, 9, 0, 16}, {9, 11, 32, 40}},
                              {{2, 3, 0, 1}},
                              {}};
    const WaveLimits limits[] = {{16, 11, 48}, {16, 4, 48}, {64, 100, 64}, {1, 1, 1}};
    for (const SampleSet& todo : sets)
        for (const WaveLimits& limit : limits)
            for (int threads : {1, 2, 5}) {
                WaveSchedule schedule(todo, limit);
                CHECK(schedule.left() == sample_count(todo));
                Seen seen;
                CHECK_FALSE(run(schedule, threads, seen, limit));
                CHECK(static_cast<std::int64_t>(seen.size()) == sample_count(todo));
                for (const auto& [sample, times] : seen)
                    CHECK(times == 1);
                CHECK(schedule.done() == todo);
                CHECK(schedule.left() == 0);
            }
}

TEST_CASE("Wave schedule: all blocks get some samples before any gets more") {
    WaveSchedule schedule(all_samples(6, 64), {16, 6, 48});
    std::vector<int> firsts;
    while (auto wave = schedule.take()) {
        for (const SampleRange& range : wave->ranges)
            firsts.push_back(range.first);
        schedule.finish(*wave);
    }
    CHECK(firsts == std::vector<int>{0, 0, 16, 16, 32, 32, 48, 48});
}

TEST_CASE("Wave schedule: few samples of many blocks fill a wave") {
    WaveSchedule schedule(all_samples(100, 2), {16, 100, 64});
    auto wave = schedule.take();
    REQUIRE(wave);
    CHECK(wave->blocks() == 32);
    CHECK(wave->samples() == 2);
}

TEST_CASE("Wave schedule: stopped, it says what is done, and goes on from there") {
    WaveSchedule schedule(all_samples(4, 32), {16, 4, 32});
    auto first = schedule.take(), second = schedule.take();
    REQUIRE(first);
    schedule.finish(*first);
    schedule.stop();
    CHECK_FALSE(schedule.take());
    schedule.finish(*second);
    CHECK(schedule.done() == all_samples(4, 16));
    CHECK(schedule.left() == 4 * 16);
    schedule.go_on();
    Seen seen;
    CHECK_FALSE(run(schedule, 2, seen, {16, 4, 32}));
    CHECK(seen.size() == 4 * 16);
    CHECK(schedule.done() == all_samples(4, 32));
}

TEST_CASE("Wave schedule: stopping releases those who wait") {
    WaveSchedule schedule(all_samples(1, 100), {1, 1, 1});
    auto taken = schedule.take();
    REQUIRE(taken);
    bool more = true;
    std::thread waiting([&] { more = schedule.take().has_value(); });
    schedule.stop();
    waiting.join();
    CHECK_FALSE(more);
    CHECK_FALSE(schedule.take());
}
