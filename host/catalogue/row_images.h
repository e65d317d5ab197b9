// Images on the device that is tested, without a word of progress (the row says how far it is), and
// what must hold of them.
#pragma once

#include "host/catalogue/stress_run.h"
#include "host/numerics/image_figures.h"
#include "host/render/device_render.h"

#include <string>
#include <utility>

namespace parhelion::stress {

/// By the run's kernels, where the options leave that open.
inline RenderResult render_quietly(const StressRun& run, const Scene& scene,
                                   RenderOptions options = {}) {
    Progress quiet(Progress::Mode::quiet);
    if (options.lanes == 0)
        options.lanes = run.kernels.lanes, options.portable |= run.kernels.portable;
    return render(scene, run.device, options, quiet);
}

inline void add_bad_samples(Check& check, const RenderReport& report) {
    check.value += static_cast<double>(report.non_finite_samples);
    check.samples += report.paths;
}

/// The image; how many of its samples were not finite is added.
inline Image image_of(const StressRun& run, const Scene& scene, Check& bad_samples,
                      const RenderOptions& options = {}) {
    RenderResult result = render_quietly(run, scene, options);
    add_bad_samples(bad_samples, result.report);
    return std::move(result.image);
}

inline Check bad_samples_check(const std::string& name) {
    return {.name = name + ": samples that are not finite", .target = 0, .unit = "samples"};
}

/// That no value differs; add_images says what does.
inline Check same_bits_check(const std::string& name) {
    return {.name = name + ": values of other bits", .target = 0, .unit = "values"};
}

/// Two images that must be the same. `where`: what one was made with.
inline void add_images(Check& check, const Image& full, const Image& part,
                       const std::string& where) {
    DifferingValues found = differing_values(full, part);
    if (found.differing > 0) check.worst_at = where;
    check.value += static_cast<double>(found.differing);
    check.samples += found.values;
}

} // namespace parhelion::stress
