// Rendering a scene on a device: the wavefront loop.
#include "host/render/path_tracer.h"

#include "host/clock.h"
#include "host/error.h"
#include "host/film/film_image.h"
#include "host/flatten/scene_features.h"
#include "host/waves/render_params.h"
#include "host/waves/wave_schedule.h"

#include <fmt/format.h>

#include <future>
#include <mutex>
#include <stdexcept>

namespace parhelion {
namespace {

/// All bounces of one wave, then its samples to the film.
void trace_wave(WaveStream& stream, const WaveParams& wave, const WorkSizes& sizes,
                const RenderParams& params, bool next_event) {
    stream.set_wave(wave);
    stream.launch(Stage::generate, 0, sizes.segments);
    for (int depth = 0; depth < params.max_depth; depth++) {
        stream.launch(Stage::intersect, depth, sizes.segments);
        stream.launch(Stage::shade, depth, sizes.segments);
        if (depth + 1 == params.max_depth) break;
        auto [paths, shadow_rays] = stream.read_counts();
        if (next_event && shadow_rays > 0) stream.launch(Stage::shadow, depth, sizes.segments);
        if (paths == 0) break;
    }
    stream.launch(Stage::accumulate, 0, wave.block_count);
    stream.collect_times();
}

/// A host thread for each of several streams: while one waits for the last work-items of a stage,
/// the device has the other's to do.
void trace_image(Pipeline& pipeline, const Scene& scene, const WorkSizes& sizes,
                 const RenderParams& params, bool next_event, Progress& progress) {
    auto start = Clock::now();
    int samples = scene.sampler.samples_per_pixel;
    int blocks = static_cast<int>(sizes.film.window.tiles());
    double paths = static_cast<double>(samples) * blocks * BLOCK_PIXELS;
    WaveSchedule schedule(blocks, samples, sizes.blocks_per_wave, sizes.samples_per_wave);
    std::mutex showing;
    auto run = [&](WaveStream& stream) {
        try {
            while (auto wave = schedule.take()) {
                trace_wave(stream, *wave, sizes, params, next_event);
                std::scoped_lock lock(showing);
                double done = schedule.finish(*wave);
                double rate = done * paths / seconds_since(start) / 1e6;
                progress.update(done, fmt::format("{:.2f} Mpaths/s", rate));
            }
        } catch (...) {
            schedule.give_up();
            throw;
        }
    };
    std::vector<std::future<void>> streams;
    auto policy = pipeline.streams().size() == 1 ? std::launch::deferred : std::launch::async;
    for (WaveStream& stream : pipeline.streams())
        streams.push_back(std::async(policy, run, std::ref(stream)));
    for (auto& stream : streams)
        stream.wait();
    for (auto& stream : streams)
        stream.get();
}

void check_bounds(Pipeline& pipeline) {
    for (WaveStream& stream : pipeline.streams())
        if (const char* buffer = stream.read_outside())
            throw std::logic_error(
                fmt::format("a kernel reads or writes outside of its buffers, from {} on", buffer));
}

/// Streams for the device to choose from: two where several cores would wait for each other.
int stream_count(const WorkSplit& split, const Device& device) {
    if (split.streams > 0) return split.streams;
    return device.is_cpu && !device.one_thread && device.compute_units > 1 &&
                   split.pool_paths >= 2 * BLOCK_PIXELS
               ? 2
               : 1;
}

/// Told before anything is rendered: systems give out memory that they do not have, and end the
/// program when it is used.
void check_film_memory(const Scene& scene, const FilmLayout& layout, const Device& device) {
    double film = static_cast<double>(layout.floats()) * sizeof(float);
    // A CPU's memory holds what is read from the film, too.
    double needed = device.is_cpu ? 2.0 * film : film;
    if (needed <= static_cast<double>(device.memory_bytes)) return;
    throw InputError(fmt::format(
        "{}: a film of {} x {} pixels and {} channels takes {:.1f} GB; {} has {:.1f} GB (accepted: "
        "a smaller --size, or a part of it, --crop)",
        scene.file, scene.film.crop_width, scene.film.crop_height, layout.channels(), needed / 1e9,
        device.name, static_cast<double>(device.memory_bytes) / 1e9));
}

} // namespace

FeatureSet render_features(const DeviceScene& scene, const RenderOptions& options) {
    const FeatureSet& wanted = scene.features.on();
    return options.all_features ? wanted | neutral_features() : wanted;
}

RenderReport start_report(const Scene& scene, const DeviceScene& flat) {
    RenderReport report;
    report.scene_file = scene.file;
    report.width = scene.film.crop_width, report.height = scene.film.crop_height;
    report.samples_per_pixel = scene.sampler.samples_per_pixel;
    report.seed = scene.sampler.seed;
    report.sampler = sample_pattern_names[static_cast<std::size_t>(scene.sampler.pattern)];
    report.replicates = scene.sampler.replicates;
    report.frame = flat.frame;
    report.primitives = flat.primitives.size();
    report.lights = flat.lights.size();
    report.device_scene_bytes = flat.bytes();
    report.features = flat.features.on().names();
    report.skipped_features = (FeatureSet::all() - flat.features.on()).names();
    report.feature_reasons = flat.features.reasons();
    return report;
}

void finish_flattening(const DeviceScene& scene, Progress& progress) {
    progress.finish(fmt::format("{} primitives", scene.primitives.size()));
    for (const std::string& note : scene.notes)
        progress.note("note: " + note);
}

void add_counts(const std::array<std::uint64_t, statistic_count>& statistics,
                RenderReport& report) {
    report.camera_rays = report.paths = statistics[statistic_camera_rays];
    report.bounce_rays = statistics[statistic_bounce_rays];
    report.shadow_rays = statistics[statistic_shadow_rays];
    for (int fault = 0; fault < fault_count; fault++) {
        std::uint64_t samples = statistics[statistic_first_fault + fault];
        report.non_finite_samples += samples;
        if (samples > 0)
            report.faults.push_back({fault_stages[fault], fault_names[fault], samples});
    }
}

RenderResult render(const Scene& scene, RenderDevice& device, const RenderOptions& options,
                    Progress& progress) {
    AovPlan aovs = plan_aovs(scene);
    int lanes = options.lanes > 0 ? options.lanes : device.device.lanes();

    WorkSplit split = options.split;
    split.streams = options.checked ? 1 : stream_count(split, device.device);
    WorkSizes sizes =
        work_sizes(film_layout(scene, aovs), scene.sampler.samples_per_pixel, lanes, split);
    check_film_memory(scene, sizes.film, device.device);

    progress.start("building the BVH");
    auto start = Clock::now();
    DeviceScene flat = make_device_scene(scene, options.light_choice);
    RenderResult result;
    result.report = start_report(scene, flat);
    result.report.device = device.device.name;
    result.report.driver = device.device.driver_version;
    result.report.lanes = lanes;
    result.report.bvh_seconds = seconds_since(start);
    finish_flattening(flat, progress);

    progress.start("compiling kernels");
    start = Clock::now();
    Pipeline pipeline(device, {lanes, options.portable, render_features(flat, options),
                               options.split.work_group_size, options.checked});
    result.report.compile_seconds = seconds_since(start);
    result.report.stages = pipeline.stage_reports();
    result.report.compiler_peak_bytes = pipeline.compiler_peak_bytes();
    progress.finish(result.report.all_cached() ? "cached" : "compiled");
    for (const std::string& note : pipeline.notes())
        progress.note("note: " + note);

    start = Clock::now();
    RenderParams params = render_params(scene, flat, sizes, aovs);
    pipeline.upload(flat);
    pipeline.allocate(sizes, params);
    result.report.upload_seconds = seconds_since(start);

    progress.start("rendering");
    start = Clock::now();
    bool next_event = flat.features.has(feature_next_event);
    trace_image(pipeline, scene, sizes, params, next_event, progress);
    if (options.checked) check_bounds(pipeline);
    result.report.render_seconds = seconds_since(start);
    add_counts(pipeline.read_statistics(), result.report);
    if (result.report.non_finite_samples > 0)
        result.report.bad_samples = pipeline.read_bad_samples();
    result.report.stages = pipeline.stage_reports();
    result.report.device_pool_bytes = pipeline.pool_bytes();
    result.report.device_film_bytes = pipeline.film_bytes();
    progress.finish(fmt::format(
        "{:.2f} Mpaths/s, {:.2f} Mrays/s",
        static_cast<double>(result.report.paths) / result.report.render_seconds / 1e6,
        static_cast<double>(result.report.rays()) / result.report.render_seconds / 1e6));
    result.image = film_image(pipeline.read_film(), sizes.film, scene, aovs, flat.frame);
    return result;
}

} // namespace parhelion
