// Waves are handed out so that every sample comes once, and those of a block in their order.
#include "host/waves/wave_schedule.h"

#include <catch2/catch.hpp>

#include <thread>

using namespace parhelion;

TEST_CASE("Wave schedule: every sample of every block once, a block's samples in order") {
    constexpr int blocks = 11, samples = 37;
    for (int threads : {1, 2, 5}) {
        WaveSchedule schedule(blocks, samples, 3, 16);
        std::vector<int> sampled(blocks); // samples so far: two threads never have the same block
        std::vector<int> disorder(threads);
        std::vector<std::thread> running;
        running.reserve(threads);
        for (int t = 0; t < threads; t++)
            running.emplace_back([&, t] {
                while (auto wave = schedule.take()) {
                    for (int b = wave->first_block; b < wave->first_block + wave->block_count;
                         b++) {
                        disorder[t] += sampled[b] != wave->first_sample;
                        sampled[b] += wave->sample_count;
                    }
                    schedule.finish(*wave);
                }
            });
        for (std::thread& thread : running)
            thread.join();
        CHECK(sampled == std::vector<int>(blocks, samples));
        CHECK(disorder == std::vector<int>(threads, 0));
    }
}

TEST_CASE("Wave schedule: the share that is done ends at 1") {
    WaveSchedule schedule(5, 4, 2, 3);
    double done = 0;
    int waves = 0;
    for (; auto wave = schedule.take(); waves++) {
        double now = schedule.finish(*wave);
        CHECK(now > done);
        done = now;
    }
    CHECK(done == 1.0);
    CHECK(waves == 6);
}

TEST_CASE("Wave schedule: giving up releases those who wait") {
    WaveSchedule schedule(1, 100, 1, 1);
    REQUIRE(schedule.take());
    bool more = true;
    std::thread waiting([&] { more = schedule.take().has_value(); });
    schedule.give_up();
    waiting.join();
    CHECK_FALSE(more);
    CHECK_FALSE(schedule.take());
}
