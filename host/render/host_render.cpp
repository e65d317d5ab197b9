// Rendering a scene with the kernels compiled as C++: slowly, and without a device.
#include "host/render/host_render.h"

#include "host/clock.h"
#include "host/film/film_image.h"
#include "host/parallel.h"
#include "host/twin/wave_memory.h"
#include "host/waves/render_params.h"
#include "host/waves/wave_schedule.h"

#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

namespace parhelion {
namespace {

/// A stage's work-items, side by side: none reads what another writes.
template<class Real>
void run_stage(Stage stage, const HostLaunch<Real>& launch, int depth, int work_items) {
    parallel_for(static_cast<std::size_t>(work_items), [&](std::size_t number) {
        run_work_item(stage, launch, depth, static_cast<int>(number));
    });
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
    bool next_event = launch.features.has(feature_next_event);
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
    auto start = Clock::now();
    WaveSchedule schedule(static_cast<int>(sizes.film.window.tiles()), samples,
                          sizes.blocks_per_wave, sizes.samples_per_wave);
    while (auto wave = schedule.take()) {
        HostLaunch<Real> launch = common;
        launch.wave = *wave;
        trace_wave(launch, sizes.segments);
        double done = schedule.finish(*wave);
        double paths =
            done * samples * static_cast<double>(sizes.film.window.tiles()) * BLOCK_PIXELS;
        progress.update(done, fmt::format("{:.3f} Mpaths/s", paths / seconds_since(start) / 1e6));
    }
}

/// As the accumulate kernel leaves it in single precision: sums and their rounding errors, which
/// together have 48 bits.
std::vector<float> film_floats(std::vector<float> film) { return film; }
std::vector<float> film_floats(const std::vector<double>& film) {
    std::vector<float> floats(film.size());
    std::size_t half = film.size() / 2;
    for (std::size_t i = 0; i < half; i++) {
        double sum = film[i] + film[half + i];
        floats[i] = static_cast<float>(sum);
        floats[half + i] = static_cast<float>(sum - floats[i]);
    }
    return floats;
}

template<class Real>
std::array<std::uint64_t, statistic_count> sum_statistics(const WaveMemory<Real>& memory) {
    std::array<std::uint64_t, statistic_count> sums{};
    for (std::size_t i = 0; i < memory.statistics.size(); i++)
        sums[i % statistic_count] += memory.statistics[i];
    return sums;
}

template<class Real>
void render_flat(const Scene& scene, const DeviceScene& flat, const RenderOptions& options,
                 Progress& progress, RenderResult& result) {
    AovPlan aovs = plan_aovs(scene);
    WorkSplit split = options.split;
    split.streams = 1;
    WorkSizes sizes =
        work_sizes(film_layout(scene, aovs), scene.sampler.samples_per_pixel, 1, split);
    WaveMemory<Real> memory(sizes);
    HostLaunch<Real> launch{scene_arrays(flat), render_params(scene, flat, sizes, aovs),
                            render_features(flat, options), WaveParams{}, memory};
    auto start = Clock::now();
    trace_image(launch, sizes, scene.sampler.samples_per_pixel, progress);
    result.report.render_seconds = seconds_since(start);
    add_counts(sum_statistics(memory), result.report);
    result.report.bad_samples = first_bad_samples({memory.bad_samples});
    result.image =
        film_image(film_floats(std::move(memory.film)), sizes.film, scene, aovs, flat.frame);
}

} // namespace

RenderResult render_on_host(const Scene& scene, const RenderOptions& options, Precision precision,
                            Progress& progress) {
    bool twice = precision == Precision::double_precision;
    progress.start("building the BVH");
    DeviceScene flat = make_device_scene(scene, options.light_choice);
    finish_flattening(flat, progress);
    RenderResult result;
    result.report = start_report(scene, flat);
    result.report.device = twice ? "host, double precision" : "host, single precision";
    progress.start(fmt::format("rendering on the {}: slow", result.report.device));
    if (twice)
        render_flat<double>(scene, flat, options, progress, result);
    else
        render_flat<float>(scene, flat, options, progress, result);
    progress.finish(fmt::format("{:.3f} Mpaths/s", static_cast<double>(result.report.paths) /
                                                       result.report.render_seconds / 1e6));
    return result;
}

} // namespace parhelion
