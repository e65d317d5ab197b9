// The wavefront loop: all bounces of all paths of a wave side by side, stage by stage, on whatever
// runs the stages.
#pragma once

#include "host/clock.h"
#include "host/progress.h"
#include "host/waves/stages.h"
#include "host/waves/wave_schedule.h"
#include "host/waves/work_sizes.h"

#include <concepts>
#include <future>
#include <mutex>
#include <span>
#include <vector>

namespace parhelion {

/// Runs the stages of one wave at a time.
template<class Device>
concept WaveDevice = requires(Device& device, const WaveParams& wave, Stage stage, int depth,
                              int work_items) {
    device.begin_wave(wave);
    device.launch(stage, depth, work_items);
    // After the last launch: of each segment its live paths and its shadow rays.
    { device.read_counts() } -> std::convertible_to<std::span<const int>>;
    device.end_wave();
};

/// What the loop depends on beside the wave.
struct WaveLoop {
    int segments, max_depth;
    bool next_event; ///< whether shadow rays are to be traced
};

inline WaveLoop wave_loop(const WorkSizes& sizes, const RenderParams& params,
                          const FeatureSet& features) {
    return {sizes.segments, params.max_depth, features.has(feature_next_event)};
}

/// All bounces of one wave, then its samples to the film.
template<WaveDevice Device>
void trace_wave(Device& device, const WaveParams& wave, const WaveLoop& loop) {
    device.begin_wave(wave);
    device.launch(Stage::generate, 0, loop.segments);
    for (int depth = 0; depth < loop.max_depth; depth++) {
        device.launch(Stage::intersect, depth, loop.segments);
        device.launch(Stage::shade, depth, loop.segments);
        if (depth + 1 == loop.max_depth) break;
        std::size_t paths = 0, shadow_rays = 0;
        std::span<const int> counts = device.read_counts();
        for (std::size_t i = 0; i < counts.size(); i += 2)
            paths += counts[i], shadow_rays += counts[i + 1];
        if (loop.next_event && shadow_rays > 0) device.launch(Stage::shadow, depth, loop.segments);
        if (paths == 0) break;
    }
    device.launch(Stage::accumulate, 0, wave.block_count);
    device.end_wave();
}

/// Which part of a picture's work a film is.
struct Share {
    double before = 0, whole = 1; ///< of all: what is done already, and what the film adds

    double at(double done) const { return before + whole * done; }
};

/// All waves of a film. A host thread for each of several devices: while one waits for the last
/// work-items of a stage, the other's are there to be done.
template<WaveDevice Device>
void trace_film(std::span<Device> devices, const WorkSizes& sizes, int samples,
                const WaveLoop& loop, Progress& progress, Share share = {}) {
    auto start = Clock::now();
    int blocks = static_cast<int>(sizes.film.window.tiles());
    double paths = static_cast<double>(samples) * blocks * BLOCK_PIXELS;
    WaveSchedule schedule(blocks, samples, sizes.blocks_per_wave, sizes.samples_per_wave);
    std::mutex showing;
    auto run = [&](Device& device) {
        try {
            while (auto wave = schedule.take()) {
                trace_wave(device, *wave, loop);
                std::scoped_lock lock(showing);
                double done = schedule.finish(*wave);
                progress.update(share.at(done), done * paths / seconds_since(start));
            }
        } catch (...) {
            schedule.give_up();
            throw;
        }
    };
    std::vector<std::future<void>> runs;
    auto policy = devices.size() == 1 ? std::launch::deferred : std::launch::async;
    for (Device& device : devices)
        runs.push_back(std::async(policy, run, std::ref(device)));
    for (auto& r : runs)
        r.wait();
    for (auto& r : runs)
        r.get();
}

} // namespace parhelion
