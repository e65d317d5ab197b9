// Rendering a scene on a device.
#include "host/render/device_render.h"

#include "host/clock.h"
#include "host/error.h"
#include "host/flatten/scene_features.h"
#include "host/render/device_engine.h"
#include "host/render/memory_plan.h"
#include "host/render/session.h"
#include "host/waves/device_waves.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion {
namespace {

/// Streams for the device to choose from: two where several cores would wait for each other.
int stream_count(const WorkSplit& split, const Device& device) {
    if (split.streams > 0) return split.streams;
    return device.is_cpu && !device.one_thread && device.compute_units > 1 &&
                   split.pool_paths >= 2 * BLOCK_PIXELS
               ? 2
               : 1;
}

DeviceMemory memory_of(const Device& device) {
    return {device.memory_bytes, device.max_allocation_bytes, device.is_cpu};
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

void note_smaller_pool(const WorkSizes& wanted, const WorkSizes& found, Progress& progress) {
    if (found.path_capacity == wanted.path_capacity) return;
    progress.note(fmt::format("note: the device has no room for {} paths in flight: there are {} "
                              "(--pool-paths); the image is the same",
                              wanted.streams * wanted.path_capacity,
                              found.streams * found.path_capacity));
}

} // namespace

FeatureSet render_features(const DeviceScene& scene, const RenderOptions& options) {
    const FeatureSet& wanted = scene.features.on();
    return options.all_features ? wanted | neutral_features() : wanted;
}

DeviceScene flattened(const Scene& scene, LightChoice light_choice, Progress& progress,
                      RenderReport& report, DeviceScene* before) {
    progress.start("building the BVH");
    auto start = Clock::now();
    DeviceScene flat = make_device_scene(scene, light_choice, before);
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

TraceCounts counts_of(std::span<const ulong> of_segments) {
    TraceCounts counts{};
    for (std::size_t i = 0; i < of_segments.size(); i++)
        counts[i % statistic_count] += of_segments[i];
    return counts;
}

OpenedRender open_on_device(const Scene& scene, RenderDevice& device, const RenderOptions& options,
                            Progress& progress) {
    RenderReport report;
    const AovPlan aovs = plan_aovs(scene);
    report.device = device.device.name;
    report.driver = device.device.driver_version;
    report.lanes = device.device.lanes(options.lanes);
    report.tracing_lanes = device.device.tracing_lanes(options.lanes);
    WorkSplit split = options.split;
    split.streams = options.checked ? 1 : stream_count(split, device.device);
    const int samples = scene.sampler.samples_per_pixel;
    const MemoryNeed need{.scene = scene,
                          .aovs = aovs,
                          .device = memory_of(device.device),
                          .lanes = report.lanes,
                          .split = split,
                          .limit = options.memory,
                          .of_group = options.group_memory,
                          .kernels_loaded = !device.programs.empty()};
    check_memory(need);

    DeviceScene flat = flattened(scene, options.light_choice, progress, report,
                                 device.scene ? &*device.scene : nullptr);
    device.scene.reset();
    const FilmContent content = film_content(scene, aovs, flat.frame);
    DeviceWaves waves = compiled(device, flat, options, progress, report);
    const std::vector<WorkSizes> sizes = sizes_in_memory(need, flat.bytes(), progress);
    const auto start = Clock::now();
    auto engine = std::make_unique<DeviceEngine>(device, std::move(flat), std::move(waves));
    const WorkSizes found = engine->allocate(scene, aovs, options.checked, options.scratch, sizes);
    note_smaller_pool(sizes.front(), found, progress);
    report.upload_seconds = seconds_since(start);
    return {std::move(engine), content, found.film.blocks(), samples, std::move(report)};
}

RenderResult rendered(OpenedRender opened, Progress& progress) {
    Session session(std::move(opened), {}, progress);
    while (!session.finished())
        session.step([] { return false; });
    return {session.image(), session.report()};
}

RenderResult render(const Scene& scene, RenderDevice& device, const RenderOptions& options,
                    Progress& progress) {
    return rendered(open_on_device(scene, device, options, progress), progress);
}

} // namespace parhelion
