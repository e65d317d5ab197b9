// `parhelion render --trace`: one sample of a scene, vertex by vertex.
#include "host/commands/render.h"
#include "host/commands/render_messages.h"
#include "host/commands/trace_report.h"
#include "host/error.h"
#include "host/image/distinct_files.h"
#include "host/image/output.h"
#include "host/json_text.h"
#include "host/scene/load.h"
#include "host/streams.h"

#include <fmt/format.h>

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

int run_trace(const RenderCommand& command, const RenderMessages& messages) {
    check_trace(command);
    Scene scene = load_scene(command.scene_file, messages.guarded(load_options(command)));
    check_distinct({{"--json", command.json_file}}, files_of(scene));
    apply_overrides(command, scene);
    Progress progress(Progress::mode_of(command.progress, command.quiet));
    for (const std::string& note : scene.notes)
        progress.note("note: " + note);
    auto [x, y] = parse_pixel(*command.pixel, scene.film);
    int sample = checked_sample(*command.sample, scene.sampler.samples_per_pixel);
    DeviceScene flat = make_device_scene(scene, command.options.light_choice);
    nlohmann::json trace = trace_json(scene, flat, trace_sample(scene, flat, x, y, sample));
    if (command.json_file.empty())
        print(trace_text(trace));
    else
        write_text_file(command.json_file, json_text(trace), existing_files(command.force));
    return static_cast<int>(ExitCode::ok);
}

} // namespace parhelion
