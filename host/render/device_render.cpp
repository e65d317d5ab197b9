// Rendering a scene on a device.
#include "host/render/device_render.h"

#include "host/clock.h"
#include "host/error.h"
#include "host/film/film_bands.h"
#include "host/film/film_image.h"
#include "host/flatten/scene_features.h"
#include "host/waves/device_waves.h"
#include "host/waves/render_params.h"
#include "host/waves/wavefront.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace parhelion {
namespace {

void check_bounds(DeviceWaves& waves) {
    for (WaveStream& stream : waves.streams())
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

/// What the film may take at once: a buffer of the device, and no more than a quarter of all.
std::size_t film_bytes_at_once(const Device& device) {
    return static_cast<std::size_t>(std::min(device.max_allocation_bytes, device.memory_bytes / 4));
}

/// Told before anything is rendered: one row of blocks that is more than the device holds.
void check_film_memory(const Scene& scene, const FilmLayout& band, const Device& device) {
    if (band.bytes() <= device.max_allocation_bytes) return;
    throw InputError(fmt::format(
        "{}: {} rows of a film of {} pixels a row and {} channels take {:.1f} GB; {} has {:.1f} GB "
        "at once (accepted: a smaller --size, or a part of it, --crop)",
        scene.file, BLOCK_SIDE, scene.film.crop_width, band.channels(),
        static_cast<double>(band.bytes()) / 1e9, device.name,
        static_cast<double>(device.max_allocation_bytes) / 1e9));
}

DeviceWaves compiled(RenderDevice& device, const DeviceScene& flat, const RenderOptions& options,
                     Progress& progress, RenderReport& report) {
    progress.start("compiling kernels");
    auto start = Clock::now();
    DeviceWaves waves(device, {.lanes = report.lanes,
                               .tracing_lanes = report.tracing_lanes,
                               .portable = options.portable,
                               .features = render_features(flat, options),
                               .work_group_size = options.split.work_group_size,
                               .checked = options.checked});
    report.compile_seconds = seconds_since(start);
    report.stages = waves.stage_reports();
    report.compiler_peak_bytes = waves.compiler_peak_bytes();
    progress.finish(report.all_cached() ? "cached" : "compiled");
    for (const std::string& note : waves.notes())
        progress.note("note: " + note);
    return waves;
}

/// What the device knows after the last wave.
void report_of(DeviceWaves& waves, RenderReport& report) {
    add_counts(waves.read_statistics(), report);
    if (report.non_finite_samples > 0) report.bad_samples = waves.read_bad_samples();
    report.stages = waves.stage_reports();
    report.device_pool_bytes = waves.pool_bytes();
    report.device_film_bytes = waves.film_bytes();
}

} // namespace

FeatureSet render_features(const DeviceScene& scene, const RenderOptions& options) {
    const FeatureSet& wanted = scene.features.on();
    return options.all_features ? wanted | neutral_features() : wanted;
}

DeviceScene flattened(const Scene& scene, LightChoice light_choice, Progress& progress,
                      RenderReport& report) {
    progress.start("building the BVH");
    auto start = Clock::now();
    DeviceScene flat = make_device_scene(scene, light_choice);
    report.bvh_seconds = seconds_since(start);
    report.scene_file = scene.file;
    report.width = scene.film.crop_width, report.height = scene.film.crop_height;
    report.samples_per_pixel = scene.sampler.samples_per_pixel;
    report.seed = scene.sampler.seed;
    report.sampler = sample_pattern_names[static_cast<std::size_t>(scene.sampler.pattern)];
    report.replicates = scene.sampler.replicates;
    report.frame = flat.frame;
    report.primitives = flat.geometry.primitives.size();
    report.lights = flat.lights.size();
    report.device_scene_bytes = flat.bytes();
    report.features = flat.features.on().names();
    report.skipped_features = (FeatureSet::all() - flat.features.on()).names();
    report.feature_reasons = flat.features.reasons();
    progress.finish(fmt::format("{} primitives", flat.geometry.primitives.size()));
    for (const std::string& note : flat.notes)
        progress.note("note: " + note);
    return flat;
}

void add_counts(std::span<const ulong> of_segments, RenderReport& report) {
    std::array<std::uint64_t, statistic_count> statistics{};
    for (std::size_t i = 0; i < of_segments.size(); i++)
        statistics[i % statistic_count] += of_segments[i];
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
    RenderResult result;
    RenderReport& report = result.report;
    AovPlan aovs = plan_aovs(scene);
    report.device = device.device.name;
    report.driver = device.device.driver_version;
    report.lanes = device.device.lanes(options.lanes);
    report.tracing_lanes = device.device.tracing_lanes(options.lanes);
    WorkSplit split = options.split;
    split.streams = options.checked ? 1 : stream_count(split, device.device);
    const std::vector<Film> bands =
        film_bands(scene.film, scene.integrator, aovs, film_bytes_at_once(device.device));
    check_film_memory(scene, film_layout(bands.front(), scene.integrator, aovs), device.device);

    DeviceScene flat = flattened(scene, options.light_choice, progress, report);
    DeviceWaves waves = compiled(device, flat, options, progress, report);
    auto start = Clock::now();
    waves.upload(flat);
    report.upload_seconds = seconds_since(start);

    progress.start("rendering");
    start = Clock::now();
    Share share{0, 0};
    for (const Film& band : bands) {
        const FilmLayout layout = film_layout(band, scene.integrator, aovs);
        const WorkSizes sizes =
            work_sizes(layout, scene.sampler.samples_per_pixel, report.lanes, split);
        const RenderParams params = render_params(scene, flat, sizes, aovs);
        waves.allocate(sizes, params);
        share.before += share.whole;
        share.whole = static_cast<double>(band.crop_height) / scene.film.crop_height;
        trace_film(std::span(waves.streams()), sizes, scene.sampler.samples_per_pixel,
                   wave_loop(sizes, params, flat.features.on()), progress, share);
        if (options.checked) check_bounds(waves);
        append_band(result.image,
                    film_image(waves.film_view(), layout, band, scene, aovs, flat.frame));
    }
    report.render_seconds = seconds_since(start);
    report_of(waves, report);
    progress.finish(fmt::format("{:.2f} Mpaths/s, {:.2f} Mrays/s",
                                static_cast<double>(report.paths) / report.render_seconds / 1e6,
                                static_cast<double>(report.rays()) / report.render_seconds / 1e6));
    return result;
}

} // namespace parhelion
