// `parhelion render`: a scene file to an image file.
#include "host/commands/render.h"

#include "host/clock.h"
#include "host/commands/bad_sample_warning.h"
#include "host/commands/cache_help.h"
#include "host/commands/compile.h"
#include "host/commands/misfit_warning.h"
#include "host/commands/render_messages.h"
#include "host/error.h"
#include "host/image/distinct_files.h"
#include "host/image/output.h"
#include "host/image/write_image.h"
#include "host/json_text.h"
#include "host/progress.h"
#include "host/render/host_render.h"
#include "host/scene/load.h"
#include "host/streams.h"
#include "parhelion_version.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <fstream>

namespace parhelion {
namespace {

void add_metadata(const Scene& scene, const RenderReport& report, Image& image) {
    image.metadata.emplace_back("software", fmt::format("parhelion {}", version_number));
    image.metadata.emplace_back("commit", std::string(version_commit));
    image.metadata.emplace_back("scene", scene.file);
    image.metadata.emplace_back("samplesPerPixel",
                                static_cast<std::int64_t>(scene.sampler.samples_per_pixel));
    image.metadata.emplace_back("seed", static_cast<std::int64_t>(scene.sampler.seed));
    image.metadata.emplace_back("device", report.device);
    if (report.lenient)
        image.metadata.emplace_back("notes", fmt::format("{}", fmt::join(report.notes, "\n")));
}

/// Returns what the file does not hold as it is.
std::vector<Misfits> write_output(const RenderCommand& command, const Scene& scene,
                                  const Image& image) {
    return write_image(command.output, image,
                       {command.exposure.value_or(0.0),
                        {scene.film.component_format, existing_files(command.force)}});
}

std::vector<UsedFile> outputs_of(const RenderCommand& command) {
    return {{"--output", command.output}, {"--stats", command.stats_file}};
}

/// What the scene asks for and a preview does not show.
void note_lost_layers(const RenderCommand& command, Scene& scene) {
    if (image_format(command.output) != ImageFormat::png || scene.integrator.aovs.empty()) return;
    std::string names;
    for (const AovRequest& aov : scene.integrator.aovs)
        names += (names.empty() ? "" : ", ") + aov.name;
    scene.notes.push_back("a .png preview holds no layers; left out: " + names);
}

/// Must come before the first OpenCL call: the CPU device reads its environment once.
void limit_threads(int threads) {
    if (threads > 0) setenv("POCL_MAX_PTHREAD_COUNT", std::to_string(threads).c_str(), 1);
}

RenderResult render_where_asked(const RenderCommand& command, const Scene& scene,
                                Progress& progress) {
    if (in_double(command))
        return render_on_host(scene, command.options, Precision::double_precision, progress);
    RenderDevice& device = open_to_the_end(choose_device(command.device));
    device.compile_beside = compile_in_own_process(device.device);
    return render(scene, device, command.options, progress);
}

} // namespace

int run_render(const RenderCommand& command) {
    const RenderMessages messages(command);
    if (command.trace) return run_trace(command, messages);
    check_output(command.output, command.force);
    if (!command.stats_file.empty()) check_output_file(command.stats_file, command.force);
    check_distinct(outputs_of(command), {{"the scene", command.scene_file}});
    check_command(command);
    limit_threads(command.threads);
    std::optional<tbb::global_control> host_threads;
    if (command.threads > 0)
        host_threads.emplace(tbb::global_control::max_allowed_parallelism, command.threads);
    Progress progress(Progress::mode_of(command.progress, command.quiet));

    progress.start("loading", command.scene_file);
    auto start = Clock::now();
    Scene scene = load_scene(command.scene_file, messages.guarded(load_options(command)));
    apply_overrides(command, scene);
    check_distinct(outputs_of(command), files_of(scene));
    note_lost_layers(command, scene);
    double load_seconds = seconds_since(start);
    progress.finish(fmt::format("{} shapes, {}x{} pixels, {} spp", scene.shapes.size(),
                                scene.film.crop_width, scene.film.crop_height,
                                scene.sampler.samples_per_pixel));
    for (const std::string& note : scene.notes)
        progress.note("note: " + note);

    RenderResult result = render_where_asked(command, scene, progress);
    result.report.load_seconds = load_seconds;
    result.report.notes = scene.notes;
    result.report.lenient = command.lenient;
    add_metadata(scene, result.report, result.image);
    // Not a matter of progress: told when quiet, too.
    bool bad = result.report.non_finite_samples > 0;
    if (bad) say(bad_sample_warning(command, result.report));

    start = Clock::now();
    result.report.misfits = write_output(command, scene, result.image);
    result.report.write_seconds = seconds_since(start);
    result.report.host_peak_bytes = peak_host_bytes();
    if (!command.stats_file.empty())
        write_text_file(command.stats_file, json_text(to_json(result.report)),
                        existing_files(command.force));
    if (!result.report.misfits.empty()) {
        bad = true;
        say(misfit_warning(command.output, scene.film, result.report));
    }
    progress.note("wrote " + command.output);
    return static_cast<int>(bad && command.strict ? ExitCode::different : ExitCode::ok);
}

Subcommand render_subcommand() {
    auto c = std::make_shared<RenderCommand>();
    return {
        .name = "render",
        .summary = "Render a scene to an .exr (linear) or .png (preview) file",
        .examples =
            "Examples:\n"
            "  parhelion render scenes/cornell-box/scene.xml -o cornell.exr --spp 256\n"
            "  parhelion render scene.xml -o preview.png --size 320x240 --spp 16 --exposure 1\n"
            "  parhelion render scene.xml -o layers.exr --aov albedo,normals,depth --stats "
            "stats.json\n"
            "  parhelion render scene.xml -o tile.exr --crop 0,0,64,64 -D light=bright --seed 7\n"
            "  parhelion render scene.xml --pixel 12,34 --sample 5 --trace" +
            std::string(cache_help),
        .options = render_options(*c),
        .run = [c] { return run_render(*c); },
    };
}

} // namespace parhelion
