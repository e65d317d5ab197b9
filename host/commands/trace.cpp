// `parhelion render --trace`: one sample of a scene, vertex by vertex.
#include "host/commands/render.h"
#include "host/commands/trace_report.h"
#include "host/error.h"
#include "host/image/output.h"
#include "host/scene/load.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace parhelion {
namespace {

/// What only an image has a use for is refused.
void check_trace(const RenderCommand& command) {
    if (command.output != RenderCommand{}.output || command.exposure || !command.stats_file.empty())
        throw InputError("--trace: renders no image, so --output, --exposure and --stats are of no "
                         "use with it");
    if (!command.json_file.empty()) check_output_file(command.json_file, command.force);
}

int checked_sample(int sample, int samples_per_pixel) {
    if (sample < 0 || sample >= samples_per_pixel)
        throw InputError(fmt::format("--sample {}: a pixel has samples 0 to {} (--spp)", sample,
                                     samples_per_pixel - 1));
    return sample;
}

} // namespace

int run_trace(const RenderCommand& command) {
    check_trace(command);
    Scene scene = load_scene(command.scene_file,
                             {parse_definitions(command.definitions), command.allow_outside});
    apply_overrides(command, scene);
    auto [x, y] = parse_pixel(*command.pixel, scene.film);
    int sample = checked_sample(*command.sample, scene.sampler.samples_per_pixel);
    DeviceScene flat = make_device_scene(scene, command.options.light_choice);
    nlohmann::json trace = trace_json(scene, flat, trace_sample(scene, flat, x, y, sample));
    if (command.json_file.empty())
        fmt::print("{}", trace_text(trace));
    else
        write_text_file(command.json_file, trace.dump(2) + '\n');
    return static_cast<int>(ExitCode::ok);
}

} // namespace parhelion
