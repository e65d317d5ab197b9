// `parhelion render`: a scene file to an image file.
#include "host/commands/render.h"

#include "host/image/exr.h"
#include "host/image/output.h"
#include "host/image/png.h"
#include "host/progress.h"
#include "host/scene/load.h"
#include "parhelion_version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

namespace parhelion {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void add_metadata(const Scene& scene, const RenderReport& report, Image& image) {
    image.metadata.emplace_back("software", fmt::format("parhelion {}", version_number));
    image.metadata.emplace_back("commit", std::string(version_commit));
    image.metadata.emplace_back("scene", scene.file);
    image.metadata.emplace_back("samplesPerPixel",
                                static_cast<std::int64_t>(scene.sampler.samples_per_pixel));
    image.metadata.emplace_back("seed", static_cast<std::int64_t>(scene.sampler.seed));
    image.metadata.emplace_back("device", report.device);
    image.metadata.emplace_back("renderTime", report.render_seconds);
}

void write_output(const std::string& file, const RenderCommand& command, const Scene& scene,
                  const Image& image, Progress& progress) {
    if (image_format(file) == ImageFormat::png) {
        std::size_t bad = write_png(file, image, command.exposure.value_or(0.0));
        if (bad > 0)
            progress.note(
                fmt::format("{}: {} pixels are not finite and shown in magenta", file, bad));
        return;
    }
    std::size_t lost = write_exr(file, image, {scene.film.component_format});
    if (lost > 0)
        progress.note(
            fmt::format("{}: {} values do not fit the film's component format", file, lost));
}

void write_stats(const std::string& file, const RenderReport& report) {
    PendingFile pending(file);
    std::ofstream out(pending.temporary_name());
    out << to_json(report).dump(2) << '\n';
    out.close();
    if (!out) throw InputError(fmt::format("{}: cannot be written", file));
    pending.commit();
}

void check_command(const RenderCommand& command) {
    if (command.exposure && image_format(command.output) != ImageFormat::png)
        throw InputError("--exposure: is for .png previews; an .exr holds linear values");
    int group = command.options.split.work_group_size;
    if (command.options.split.pool_paths < BLOCK_PIXELS ||
        command.options.split.segment_paths < 1 || group < 1)
        throw InputError(fmt::format(
            "--pool-paths must be at least {}, --segment-paths and --work-group-size at least 1",
            BLOCK_PIXELS));
    int lanes = command.options.lanes;
    if (lanes != 0 && lanes != 1 && lanes != 8 && lanes != 16)
        throw InputError(
            fmt::format("--lanes {}: there are 1, 8 and 16 (0: what suits the device)", lanes));
    if (command.threads < 0)
        throw InputError(fmt::format("--threads {}: must be 0 (all) or more", command.threads));
}

/// Must come before the first OpenCL call: the CPU device reads its environment once.
void limit_threads(int threads) {
    if (threads > 0) setenv("POCL_MAX_PTHREAD_COUNT", std::to_string(threads).c_str(), 1);
}

} // namespace

void run_render(const RenderCommand& command) {
    check_output(command.output, command.force);
    check_command(command);
    limit_threads(command.threads);
    std::optional<tbb::global_control> host_threads;
    if (command.threads > 0)
        host_threads.emplace(tbb::global_control::max_allowed_parallelism, command.threads);
    Progress progress = Progress::standard(command.quiet);

    progress.start("loading " + command.scene_file);
    auto start = Clock::now();
    Scene scene = load_scene(command.scene_file,
                             {parse_definitions(command.definitions), command.allow_outside});
    apply_overrides(command, scene);
    double load_seconds = seconds_since(start);
    progress.finish(fmt::format("{} shapes, {}x{} pixels, {} spp", scene.shapes.size(),
                                scene.film.crop_width, scene.film.crop_height,
                                scene.sampler.samples_per_pixel));
    for (const std::string& note : scene.notes)
        progress.note("note: " + note);

    RenderResult result = render(scene, choose_device(command.device), command.options, progress);
    result.report.load_seconds = load_seconds;
    add_metadata(scene, result.report, result.image);
    if (result.report.non_finite_samples > 0)
        progress.note(
            fmt::format("warning: {} samples were not finite; they were left out of the image",
                        result.report.non_finite_samples));

    start = Clock::now();
    write_output(command.output, command, scene, result.image, progress);
    result.report.write_seconds = seconds_since(start);
    result.report.host_peak_bytes = peak_host_bytes();
    if (!command.stats_file.empty()) write_stats(command.stats_file, result.report);
    progress.note("wrote " + command.output);
}

void add_render_command(CLI::App& app) {
    CLI::App* sub =
        app.add_subcommand("render", "Render a scene to an .exr (linear) or .png (preview) file");
    auto command = std::make_shared<RenderCommand>();
    command->output = "out.exr";
    sub->add_option("scene", command->scene_file, "Scene file (Mitsuba 3 XML)")->required();
    sub->add_option("-o,--output", command->output, "Image to write, .exr or .png")
        ->capture_default_str();
    sub->add_option("--spp", command->samples, "Samples per pixel");
    sub->add_option("--integrator", command->integrator, "path, direct, normals, depth or aov");
    sub->add_option("--max-depth", command->max_depth,
                    "Longest path in edges: 1 emitters only, 2 direct light, -1 no limit");
    sub->add_option("--rr-depth", command->rr_depth, "Russian roulette from this many vertices on");
    sub->add_option("--size", command->size, "Film size, WIDTHxHEIGHT");
    sub->add_option("--crop", command->crop, "Part of the film, X,Y,WIDTH,HEIGHT");
    sub->add_option("--seed", command->seed, "Seed of the random numbers");
    sub->add_option("--aov", command->aovs, "Layers beside the image, e.g. albedo,normals,depth")
        ->delimiter(',');
    sub->add_option("-D,--define", command->definitions,
                    "name=value for the scene's $name (repeat for more)")
        ->allow_extra_args(false);
    sub->add_option("--device", command->device,
                    "Device by index or part of its name (see `parhelion devices`)");
    sub->add_option("--exposure", command->exposure, "Stops of exposure for .png");
    sub->add_option("--stats", command->stats_file, "Write times, counts and memory as JSON");
    sub->add_flag("--force", command->force, "Overwrite the image if it exists");
    sub->add_flag("-q,--quiet", command->quiet, "No progress");
    sub->add_flag("--allow-outside", command->allow_outside,
                  "Let the scene name files outside its own folder");
    sub->add_option("--threads", command->threads, "CPU threads, 0 for all")->capture_default_str();
    constexpr const char* split = "How work is split (the image stays the same to the bit)";
    sub->add_option("--pool-paths", command->options.split.pool_paths, "Paths in flight")
        ->capture_default_str()
        ->group(split);
    sub->add_option("--segment-paths", command->options.split.segment_paths,
                    "Paths a work-item owns")
        ->capture_default_str()
        ->group(split);
    sub->add_option("--work-group-size", command->options.split.work_group_size,
                    "Work-items in a group")
        ->capture_default_str()
        ->group(split);
    sub->add_option("--lanes", command->options.lanes,
                    "Values a kernel handles at once: 1, 8, 16; 0 for the device's")
        ->capture_default_str()
        ->group(split);
    sub->add_flag("--portable", command->options.portable, "Kernels without x86 intrinsics")
        ->group(split);
    sub->add_flag("--all-features", command->options.all_features,
                  "Kernels not specialised to the scene")
        ->group(split);
    sub->add_flag("!--no-next-event", command->next_event, "Do not sample emitters")->group(split);
    sub->footer(
        "Examples:\n"
        "  parhelion render scenes/cornell-box/scene.xml -o cornell.exr --spp 256\n"
        "  parhelion render scene.xml -o preview.png --size 320x240 --spp 16 --exposure 1\n"
        "  parhelion render scene.xml -o layers.exr --aov albedo,normals,depth --stats stats.json\n"
        "  parhelion render scene.xml -o tile.exr --crop 0,0,64,64 -D light=bright --seed 7");
    sub->callback([command] { run_render(*command); });
}

} // namespace parhelion
