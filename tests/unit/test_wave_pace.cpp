// No launch takes longer than it may, whatever the device and whatever the picture shows where.
#include "host/waves/wave_pace.h"
#include "host/waves/wave_schedule.h"

#include <catch2/catch.hpp>

#include <functional>
#include <mutex>
#include <thread>

using namespace parhelion;

namespace {

constexpr int most = 4096; // a pool of 64 Ki paths

/// Seconds of the longest launch of a wave.
using Device = std::function<double(const Wave&)>;

struct Paced {
    std::vector<int> waves; ///< blocks times samples of each, in the order in which they end
    std::vector<double> seconds;
};

/// Renders on a device of so many streams.
Paced paced(const SampleSet& todo, const WaveLimits& limits, const Device& device, int streams) {
    WaveSchedule schedule(todo, limits);
    Paced result;
    std::mutex mutex;
    std::vector<std::jthread> running;
    running.reserve(streams);
    for (int t = 0; t < streams; t++)
        running.emplace_back([&] {
            while (auto wave = schedule.take()) {
                const double seconds = device(*wave);
                schedule.finish(*wave, seconds);
                const std::scoped_lock lock(mutex);
                result.waves.push_back(wave->blocks() * wave->samples());
                result.seconds.push_back(seconds);
            }
        });
    running.clear();
    CHECK(schedule.done() == todo);
    return result;
}

double seconds_of(const Wave& wave, double seconds_per_path) {
    return BLOCK_PIXELS * wave.blocks() * wave.samples() * seconds_per_path;
}

double longest(const Paced& render, std::size_t from) {
    return *std::max_element(render.seconds.begin() + static_cast<std::ptrdiff_t>(from),
                             render.seconds.end());
}

} // namespace

TEST_CASE("Wave pace: the time of a launch grows with its paths at most") {
    // Waves that were as large as they might be.
    CHECK(next_wave_limit(256, most, 256, 0.001) == 1024);   // four times at most
    CHECK(next_wave_limit(256, most, 256, 0.04) == 384);     // 0.06 s
    CHECK(next_wave_limit(256, most, 256, 0.07) == 256);     // near enough
    CHECK(next_wave_limit(256, most, 256, 0.12) == 128);     // 0.06 s again
    CHECK(next_wave_limit(256, most, 256, 100.0) == 1);      // never nothing
    CHECK(next_wave_limit(3000, most, 3000, 0.001) == most); // never more than the pool
    CHECK(next_wave_limit(256, most, 256, 0.0) == 1024);     // a device without a clock
    // Others: a small wave tells nothing of large ones that are fast, but of slow ones.
    CHECK(next_wave_limit(1024, most, 16, 0.001) == 1024);
    CHECK(next_wave_limit(1024, most, 16, 0.08001) == 11);
    CHECK(next_wave_limit(128, most, 256, 0.001) == 1024);
    CHECK(next_wave_limit(128, most, 1024, 0.2) == 128);
    CHECK(first_wave_limit(most) == 256);
    CHECK(first_wave_limit(16) == 16);
}

TEST_CASE("Wave pace: on a fast device all waves but the first fill the pool") {
    const SampleSet todo = all_samples(10000, 64);
    for (int streams : {1, 2}) {
        const Paced render = paced(
            todo, {16, 10000, most}, [](const Wave& w) { return seconds_of(w, 1e-7); }, streams);
        CHECK(std::count_if(render.waves.begin(), render.waves.end(),
                            [](int wave) { return wave < most; }) <= 4 * streams);
        CHECK(render.waves.front() == 256);
    }
}

TEST_CASE("Wave pace: on a slow one launches are as long as they may be, and no longer") {
    const SampleSet todo = all_samples(1000, 32);
    for (double per_path : {2e-6, 5e-6, 2e-5, 1e-4})
        for (int streams : {1, 3}) {
            const Paced render = paced(
                todo, {16, 1000, most}, [&](const Wave& w) { return seconds_of(w, per_path); },
                streams);
            const std::size_t early = 2 * streams;
            CHECK(longest(render, early) <= longest_launch);
            CHECK(longest(render, early) >= 0.2 * longest_launch);
        }
    // One group of samples of one block is the smallest there can be.
    const Paced render = paced(
        todo, {16, 1000, most}, [](const Wave& w) { return seconds_of(w, 1e-2); }, 1);
    CHECK(std::all_of(render.waves.begin() + 1, render.waves.end(),
                      [](int wave) { return wave == FILM_SAMPLES; }));
}

TEST_CASE("Wave pace: where a picture is slow, waves get smaller, and larger again behind it") {
    // The lower half of the blocks takes ten times as long.
    const Device device = [](const Wave& w) {
        return seconds_of(w, w.ranges.front().first_block < 5000 ? 4e-7 : 4e-6);
    };
    const Paced render = paced(all_samples(10000, 64), {16, 10000, most}, device, 1);
    const auto over = [&](double limit) {
        return std::count_if(render.seconds.begin(), render.seconds.end(),
                             [&](double s) { return s > limit; });
    };
    CHECK(over(longest_launch) <= 4); // each time it gets there
    CHECK(over(0.8 * longest_launch) <= 4);
    CHECK(std::count(render.waves.begin(), render.waves.end(), most) > 4 * 5);
}

TEST_CASE("Wave pace: a film that is too small for many blocks is cut by samples") {
    // 2 blocks of 2048 samples fill the pool.
    const Paced render = paced(
        all_samples(2, 100000), {2048, 2, most}, [](const Wave& w) { return seconds_of(w, 1e-5); },
        1);
    CHECK(longest(render, 1) <= longest_launch);
    CHECK(longest(render, 1) >= 0.4 * longest_launch);
    for (std::size_t i = 0; i + 2 < render.waves.size(); i++)
        CHECK(render.waves[i] % FILM_SAMPLES == 0);
}
