// Rendering a scene with the kernels compiled as C++: slowly, and without a device.
#include "host/render/host_render.h"

#include "host/film/tiled_film.h"
#include "host/render/wave_hits.h"
#include "host/twin/twin_waves.h"
#include "host/waves/render_params.h"
#include "host/waves/wavefront.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace parhelion {
namespace {

/// The kernels as C++, and a film in one band.
template<class Real>
class HostEngine : public Engine {
public:
    HostEngine(DeviceScene flat, const Scene& scene, const RenderOptions& options,
               const AovPlan& aovs, const WorkSizes& sizes)
        : scene_(std::move(flat)), sizes_(sizes), crop_(scene.film), memory_(sizes),
          params_(render_params(scene, scene_, sizes, aovs)),
          features_(render_features(scene_, options)) {
        if (sizes_.film.shape_ids)
            coverage_.emplace(sizes_.film.window, crop_, scene_.filter_values,
                              sizes_.film.blocks());
    }

    void trace(WaveSchedule& schedule, const std::function<void()>& on_wave) override {
        TwinWaves<Real> waves({scene_arrays(scene_), params_, features_, WaveParams{}, memory_});
        trace_waves(std::span(&waves, 1), schedule, wave_loop(sizes_, params_, features_), on_wave,
                    [&](TwinWaves<Real>&, const Wave& wave) { gather_hits(wave); });
    }
    WaveLimits wave_limits() const override { return sizes_.wave_limits(); }
    int blocks_at_once() const override { return sizes_.film.blocks(); }
    void turn_to(int) override {}

    std::unique_ptr<FilmSums> film() override {
        return std::make_unique<TiledFilm>(
            std::vector<std::span<const std::uint32_t>>{memory_.film}, sizes_.film, crop_,
            coverage_ ? &*coverage_ : nullptr);
    }
    void fill_film(const FilmSums& sums) override {
        put_sums(sums, sizes_.film, crop_, {memory_.film});
        if (coverage_) coverage_->add_film(sums);
    }

    TraceCounts counts() override { return counts_of(memory_.statistics); }
    std::vector<BadSample> bad_samples() override {
        return first_bad_samples({memory_.bad_samples});
    }
    void report(RenderReport&) override {}

private:
    void gather_hits(const Wave& wave) {
        if (!coverage_) return;
        const std::size_t slots = std::size_t{BLOCK_PIXELS} * wave.blocks() * wave.samples();
        add_hits<Real>(*coverage_, wave, sizes_.film, [&](int channel) {
            return std::span<const Real>(memory_.results)
                .subspan(static_cast<std::size_t>(channel) * sizes_.result_stride(), slots);
        });
    }

    DeviceScene scene_;
    WorkSizes sizes_;
    Film crop_;
    WaveMemory<Real> memory_;
    RenderParams params_;
    FeatureSet features_;
    std::optional<CoverageTiles> coverage_; // where it is asked for
};

} // namespace

OpenedRender open_on_host(const Scene& scene, const RenderOptions& options, Precision precision,
                          Progress& progress) {
    const bool twice = precision == Precision::double_precision;
    RenderReport report;
    DeviceScene flat = flattened(scene, options.light_choice, progress, report);
    report.device = twice ? "host, double precision" : "host, single precision";
    const AovPlan aovs = plan_aovs(scene);
    WorkSplit split = options.split;
    split.streams = 1;
    const int samples = scene.sampler.samples_per_pixel;
    const WorkSizes sizes = work_sizes(film_layout(scene, aovs), samples, 1, split);
    const FilmContent content = film_content(scene, aovs, flat.frame);
    const std::string place = fmt::format("on the {}: slow", report.device);
    std::unique_ptr<Engine> engine;
    if (twice)
        engine = std::make_unique<HostEngine<double>>(std::move(flat), scene, options, aovs, sizes);
    else
        engine = std::make_unique<HostEngine<float>>(std::move(flat), scene, options, aovs, sizes);
    return {std::move(engine), content, sizes.film.blocks(), samples, std::move(report), place};
}

RenderResult render_on_host(const Scene& scene, const RenderOptions& options, Precision precision,
                            Progress& progress) {
    return rendered(open_on_host(scene, options, precision, progress), progress);
}

} // namespace parhelion
