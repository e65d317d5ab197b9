// Rendering a scene on a device.
#include "host/render/device_render.h"

#include "host/clock.h"
#include "host/error.h"
#include "host/film/tiled_film.h"
#include "host/flatten/scene_features.h"
#include "host/render/session.h"
#include "host/render/wave_hits.h"
#include "host/waves/device_waves.h"
#include "host/waves/render_params.h"
#include "host/waves/wavefront.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

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

/// What a band of the film may take: a buffer of the device, and no more than a quarter of all.
std::size_t film_bytes_at_once(const Device& device) {
    return static_cast<std::size_t>(std::min(device.max_allocation_bytes, device.memory_bytes / 4));
}

/// Told before anything is rendered: a film that is more than the device holds, or of which it does
/// not take one row of blocks at once.
void check_film_memory(const Scene& scene, const FilmLayout& layout, const Device& device) {
    const std::uint64_t bytes = std::uint64_t{layout.bytes()} * layout.bands();
    if (bytes > device.memory_bytes)
        throw InputError(fmt::format(
            "{}: a film of {} x {} pixels and {} channels takes {:.1f} GB; {} has {:.1f} GB "
            "(accepted: a smaller --size, or a part of it, --crop)",
            scene.file, scene.film.crop_width, scene.film.crop_height, layout.channels(),
            static_cast<double>(bytes) / 1e9, device.name,
            static_cast<double>(device.memory_bytes) / 1e9));
    if (layout.bytes() <= device.max_allocation_bytes) return;
    throw InputError(fmt::format(
        "{}: {} rows of a film of {} pixels a row and {} channels take {:.1f} GB; {} has {:.1f} GB "
        "at once (accepted: a smaller --size, or a part of it, --crop)",
        scene.file, BLOCK_SIDE, scene.film.crop_width, layout.channels(),
        static_cast<double>(layout.bytes()) / 1e9, device.name,
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

void note_smaller_pool(const WorkSizes& wanted, const WorkSizes& found, Progress& progress) {
    if (found.path_capacity == wanted.path_capacity) return;
    progress.note(fmt::format("note: the device has no room for {} paths in flight: there are {} "
                              "(--pool-paths); the image is the same",
                              wanted.streams * wanted.path_capacity,
                              found.streams * found.path_capacity));
}

/// The film of a device's buffers.
class DeviceFilm : public FilmSums {
public:
    DeviceFilm(const DeviceWaves& waves, const FilmLayout& layout, const Film& crop,
               const CoverageTiles* coverage)
        : views_(waves.film_views<const cl_uint>()), film_(values(views_), layout, crop, coverage) {
    }

    void add_row(int channel, int y, SumRow& row) const override { film_.add_row(channel, y, row); }
    void add_coverage(int y, ShapeWeights& row) const override { film_.add_coverage(y, row); }

    template<class Word>
    static std::vector<std::span<Word>> values(const std::deque<BufferView<Word>>& views) {
        std::vector<std::span<Word>> all;
        all.reserve(views.size());
        for (const BufferView<Word>& view : views)
            all.push_back(view.values());
        return all;
    }

private:
    std::deque<BufferView<const cl_uint>> views_;
    TiledFilm film_;
};

class DeviceEngine : public Engine {
public:
    DeviceEngine(RenderDevice& device, DeviceScene scene, DeviceWaves waves)
        : device_(device), scene_(std::move(scene)), waves_(std::move(waves)) {}
    DeviceEngine(const DeviceEngine&) = delete;
    DeviceEngine& operator=(const DeviceEngine&) = delete;
    ~DeviceEngine() override {
        if (!device_.keeps_scenes) return;
        device_.scene.emplace();
        device_.scene->texels = std::move(scene_.texels);
        device_.scene->images = std::move(scene_.images);
    }

    /// Film and streams, of the first of the sizes that there is room for, which is returned.
    WorkSizes allocate(const Scene& scene, const AovPlan& aovs, bool checked,
                       std::span<const WorkSizes> sizes) {
        const auto params = [&](const WorkSizes& s) {
            return render_params(scene, scene_, s, aovs);
        };
        waves_.upload(scene_);
        sizes_ = waves_.allocate(sizes, params);
        loop_ = wave_loop(sizes_, params(sizes_), scene_.features.on());
        crop_ = scene.film;
        if (sizes_.film.shape_ids)
            coverage_.emplace(sizes_.film.window, crop_, scene_.filter_values);
        checked_ = checked;
        return sizes_;
    }

    void trace(WaveSchedule& schedule, const std::function<void()>& on_wave) override {
        trace_waves(std::span(waves_.streams()), schedule, loop_, on_wave,
                    [&](WaveStream& stream, const Wave& wave) { gather_hits(stream, wave); });
        if (checked_) check_bounds();
    }
    WaveLimits wave_limits() const override { return sizes_.wave_limits(); }

    std::unique_ptr<FilmSums> film() override {
        return std::make_unique<DeviceFilm>(waves_, sizes_.film, crop_,
                                            coverage_ ? &*coverage_ : nullptr);
    }
    void fill_film(const FilmSums& sums) override {
        const auto views = waves_.film_views<cl_uint>();
        put_sums(sums, sizes_.film, crop_, DeviceFilm::values(views));
        if (coverage_) coverage_->add_film(sums);
    }

    TraceCounts counts() override { return counts_of(waves_.read_statistics()); }
    std::vector<BadSample> bad_samples() override { return waves_.read_bad_samples(); }
    void report(RenderReport& report) override {
        report.stages = waves_.stage_reports();
        report.device_pool_bytes = waves_.pool_bytes();
        report.device_film_bytes = waves_.film_bytes();
    }

private:
    void gather_hits(WaveStream& stream, const Wave& wave) {
        if (!coverage_) return;
        const std::size_t slots = std::size_t{BLOCK_PIXELS} * wave.blocks() * wave.samples();
        add_hits<float>(*coverage_, wave, sizes_.film,
                        [&](int channel) { return stream.read_results(channel, slots); });
    }
    void check_bounds() {
        for (WaveStream& stream : waves_.streams())
            if (const char* buffer = stream.read_outside())
                throw std::logic_error(fmt::format(
                    "a kernel reads or writes outside of its buffers, from {} on", buffer));
    }

    RenderDevice& device_;
    DeviceScene scene_;
    DeviceWaves waves_; // reads the scene where it is
    WorkSizes sizes_;
    WaveLoop loop_{};
    Film crop_;
    std::optional<CoverageTiles> coverage_; // where it is asked for
    bool checked_ = false;
};

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
    const FilmLayout layout =
        in_bands(film_layout(scene, aovs),
                 split.film_bytes > 0 ? split.film_bytes : film_bytes_at_once(device.device));
    check_film_memory(scene, layout, device.device);
    const int samples = scene.sampler.samples_per_pixel;
    const std::vector<WorkSizes> sizes = pool_choices(layout, samples, report.lanes, split);

    DeviceScene flat = flattened(scene, options.light_choice, progress, report,
                                 device.scene ? &*device.scene : nullptr);
    device.scene.reset();
    const FilmContent content = film_content(scene, aovs, flat.frame);
    DeviceWaves waves = compiled(device, flat, options, progress, report);
    const auto start = Clock::now();
    auto engine = std::make_unique<DeviceEngine>(device, std::move(flat), std::move(waves));
    const WorkSizes found = engine->allocate(scene, aovs, options.checked, sizes);
    note_smaller_pool(sizes.front(), found, progress);
    report.upload_seconds = seconds_since(start);
    return {std::move(engine), content, layout.blocks(), samples, std::move(report)};
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
