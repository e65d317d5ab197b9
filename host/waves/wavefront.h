// The wavefront loop: all bounces of all paths of a wave side by side, stage by stage, on whatever
// runs the stages.
#pragma once

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
concept WaveDevice = requires(Device& device, const Wave& wave, Stage stage, int depth,
                              int work_items) {
    device.begin_wave(wave);
    device.launch(stage, depth, work_items);
    // After the last launch: of each segment its live paths and its shadow rays.
    { device.read_counts() } -> std::convertible_to<std::span<const int>>;
    // Waits; how long the longest launch took, seconds, or 0.
    { device.end_wave() } -> std::convertible_to<double>;
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

/// All bounces of one wave, then its samples to the film. How long the longest launch took,
/// seconds; 0 where that is not known.
template<WaveDevice Device>
double trace_wave(Device& device, const Wave& wave, const WaveLoop& loop) {
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
    device.launch(Stage::accumulate, 0, wave.blocks());
    return device.end_wave();
}

/// Waves until there are none left. A host thread for each of several devices: while one waits for
/// the last work-items of a stage, the other's are there to be done. `on_wave` is called after each
/// wave, by one thread at a time; it may stop the schedule. `gather(device, wave)` before that, by
/// the thread that has traced the wave, whose results are still there.
template<WaveDevice Device, class OnWave, class Gather>
void trace_waves(std::span<Device> devices, WaveSchedule& schedule, const WaveLoop& loop,
                 const OnWave& on_wave, const Gather& gather) {
    std::mutex telling;
    auto run = [&](Device& device) {
        try {
            while (auto wave = schedule.take()) {
                const double longest = trace_wave(device, *wave, loop);
                gather(device, *wave);
                std::scoped_lock lock(telling);
                schedule.finish(*wave, longest);
                on_wave();
            }
        } catch (...) {
            schedule.stop();
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
