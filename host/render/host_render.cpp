// Rendering a scene with the kernels compiled as C++: slowly, and without a device.
#include "host/render/host_render.h"

#include "host/clock.h"
#include "host/film/film_image.h"
#include "host/twin/twin_waves.h"
#include "host/waves/render_params.h"
#include "host/waves/wavefront.h"

#include <fmt/format.h>

#include <array>
#include <utility>
#include <vector>

namespace parhelion {
namespace {

template<class Real>
void render_flat(const Scene& scene, const DeviceScene& flat, const RenderOptions& options,
                 Progress& progress, RenderResult& result) {
    AovPlan aovs = plan_aovs(scene);
    WorkSplit split = options.split;
    split.streams = 1;
    WorkSizes sizes =
        work_sizes(film_layout(scene, aovs), scene.sampler.samples_per_pixel, 1, split);
    WaveMemory<Real> memory(sizes);
    RenderParams params = render_params(scene, flat, sizes, aovs);
    FeatureSet features = render_features(flat, options);
    TwinWaves<Real> waves({scene_arrays(flat), params, features, WaveParams{}, memory});
    auto start = Clock::now();
    trace_film(std::span<TwinWaves<Real>>(&waves, 1), sizes, scene.sampler.samples_per_pixel,
               wave_loop(sizes, params, features), progress);
    result.report.render_seconds = seconds_since(start);
    add_counts(memory.statistics, result.report);
    result.report.bad_samples = first_bad_samples({memory.bad_samples});
    result.image = film_image(memory.film, sizes.film, scene.film, scene, aovs, flat.frame);
}

} // namespace

RenderResult render_on_host(const Scene& scene, const RenderOptions& options, Precision precision,
                            Progress& progress) {
    bool twice = precision == Precision::double_precision;
    RenderResult result;
    DeviceScene flat = flattened(scene, options.light_choice, progress, result.report);
    result.report.device = twice ? "host, double precision" : "host, single precision";
    progress.start("rendering", fmt::format("on the {}: slow", result.report.device));
    if (twice)
        render_flat<double>(scene, flat, options, progress, result);
    else
        render_flat<float>(scene, flat, options, progress, result);
    progress.finish(fmt::format("{:.3f} Mpaths/s", static_cast<double>(result.report.paths) /
                                                       result.report.render_seconds / 1e6));
    return result;
}

} // namespace parhelion
