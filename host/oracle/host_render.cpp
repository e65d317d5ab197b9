// Rendering a scene with the kernels compiled as C++: slowly, and without a device.
#include "host/oracle/host_render.h"

#include "host/clock.h"
#include "host/oracle/wave_memory.h"
#include "host/render/film_image.h"
#include "host/render/render_params.h"
#include "host/render/wave_schedule.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <utility>

namespace parhelion {
namespace {

/// A stage's work-items, side by side: none reads what another writes.
template<class Real>
void run_stage(Stage stage, const HostLaunch<Real>& launch, int depth, int work_items) {
    tbb::parallel_for(0, work_items,
                      [&](int number) { run_work_item(stage, launch, depth, number); });
}

/// Live paths and shadow rays of all segments.
std::pair<int, int> sum_counts(const std::vector<int>& counts) {
    std::pair<int, int> sum{0, 0};
    for (std::size_t i = 0; i < counts.size(); i += 2)
        sum.first += counts[i], sum.second += counts[i + 1];
    return sum;
}

/// All bounces of one wave, then its samples to the film.
template<class Real>
void trace_wave(const HostLaunch<Real>& launch, int segments) {
    bool next_event = launch.features & feature_bit(feature_next_event);
    run_stage(Stage::generate, launch, 0, segments);
    for (int depth = 0; depth < launch.params.max_depth; depth++) {
        run_stage(Stage::intersect, launch, depth, segments);
        run_stage(Stage::shade, launch, depth, segments);
        if (depth + 1 == launch.params.max_depth) break;
        auto [paths, shadow_rays] = sum_counts(launch.memory.counts);
        if (next_event && shadow_rays > 0) run_stage(Stage::shadow, launch, depth, segments);
        if (paths == 0) break;
    }
    run_stage(Stage::accumulate, launch, 0, launch.wave.block_count);
}

template<class Real>
void trace_image(const HostLaunch<Real>& common, const WorkSizes& sizes, int samples,
                 Progress& progress) {
    WaveSchedule schedule(static_cast<int>(sizes.window.tiles()), samples, sizes.blocks_per_wave,
                          sizes.samples_per_wave);
    while (auto wave = schedule.take()) {
        HostLaunch<Real> launch = common;
        launch.wave = *wave;
        trace_wave(launch, sizes.segments);
        progress.update(schedule.finish(*wave), "");
    }
}

} // namespace

RenderResult render_on_host(const Scene& scene, const RenderOptions& options, Progress& progress) {
    AovPlan aovs = plan_aovs(scene.integrator);
    progress.start("building the BVH");
    DeviceScene flat = make_device_scene(scene, options.light_choice);
    progress.finish(fmt::format("{} primitives", flat.primitives.size()));

    int film_channels =
        result_field_count + aovs.channels + (scene.integrator.second_moment ? 3 : 0);
    WorkSplit split = options.split;
    split.streams = 1;
    WorkSizes sizes = work_sizes(sample_window(scene.film), scene.sampler.samples_per_pixel, 1,
                                 film_channels, split);
    WaveMemory<float> memory(sizes);
    HostLaunch<float> launch{scene_arrays(flat), render_params(scene, flat, sizes, aovs),
                             render_features(flat, options), WaveParams{}, memory};
    RenderResult result;
    progress.start("rendering on the host");
    auto start = Clock::now();
    trace_image(launch, sizes, scene.sampler.samples_per_pixel, progress);
    result.report.render_seconds = seconds_since(start);
    progress.finish("");
    result.image = film_image(memory.film, sizes, scene, aovs);
    return result;
}

} // namespace parhelion
