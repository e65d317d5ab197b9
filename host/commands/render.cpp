// `parhelion render`: a scene file to an image file.
#include "host/commands/render.h"

#include "host/clock.h"
#include "host/commands/compile.h"
#include "host/error.h"
#include "host/image/exr.h"
#include "host/image/output.h"
#include "host/image/png.h"
#include "host/progress.h"
#include "host/scene/load.h"
#include "parhelion_version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
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
    check_split(command.options);
    if (command.threads < 0)
        throw InputError(fmt::format("--threads {}: must be 0 (all) or more", command.threads));
}

/// Must come before the first OpenCL call: the CPU device reads its environment once.
void limit_threads(int threads) {
    if (threads > 0) setenv("POCL_MAX_PTHREAD_COUNT", std::to_string(threads).c_str(), 1);
}

std::vector<Option> image_options(RenderCommand& c) {
    return {
        {"scene", &c.scene_file, "Scene file (Mitsuba 3 XML)", {.required = true}},
        {"-o,--output", &c.output, "Image to write, .exr or .png"},
        {"--spp", &c.samples, "Samples per pixel"},
        {"--size", &c.size, "Film size, WIDTHxHEIGHT"},
        {"--crop", &c.crop, "Part of the film, X,Y,WIDTH,HEIGHT"},
        {"--seed", &c.seed, "Seed of the random numbers"},
        {"--exposure", &c.exposure, "Stops of exposure for .png"},
        {"--stats", &c.stats_file, "Write times, counts and memory as JSON"},
        {"--force", &c.force, "Overwrite the image if it exists"},
        {"--threads", &c.threads, "CPU threads, 0 for all"},
    };
}

std::vector<Option> of_split(std::vector<Option> options) {
    for (Option& option : options)
        option.rules.group = "How work is split (the image stays the same to the bit)";
    return options;
}

std::vector<Option> pool_options(RenderCommand& c) {
    return of_split({
        {"--pool-paths", &c.options.split.pool_paths, "Paths in flight"},
        {"--segment-paths", &c.options.split.segment_paths, "Paths a work-item owns"},
        {"--streams", &c.options.split.streams,
         "Waves under way at once, which share the pool; 0 for what suits the device"},
    });
}

std::vector<Option> program_options(RenderCommand& c) {
    return of_split({
        {"--work-group-size", &c.options.split.work_group_size, "Work-items in a group"},
        {"--lanes", &c.options.lanes,
         "Values a kernel handles at once: 1, 8, 16; 0 for the device's"},
        {"--portable", &c.options.portable, "Kernels without x86 intrinsics"},
        {"--all-features", &c.options.all_features, "Kernels not specialised to the scene"},
    });
}

} // namespace

std::vector<Option> kernel_options(RenderCommand& c) {
    std::vector<Option> options{
        {"--integrator", &c.integrator, "path, direct, normals, depth or aov"},
        {"--max-depth", &c.max_depth,
         "Longest path in edges: 1 emitters only, 2 direct light, -1 no limit"},
        {"--rr-depth", &c.rr_depth, "Russian roulette from this many vertices on"},
        {"!--no-next-event", &c.next_event, "Do not sample emitters"},
        {"--sampler", &c.sampler,
         "sobol (a pattern over the samples of a pixel, the default) or independent"},
        {"--filter-by", &c.filter_method,
         "splatting (a sample counts for all pixels that the filter reaches, the default) or "
         "sampling (for one pixel alone: pixels are independent)"},
        {"--aov",
         &c.aovs,
         "Layers beside the image, e.g. albedo,normals,depth",
         {.delimiter = ','}},
        {"-D,--define", &c.definitions, "name=value for the scene's $name (repeat for more)"},
        {"--device", &c.device, "Device by index or part of its name (see `parhelion devices`)"},
        {"-q,--quiet", &c.quiet, "No progress"},
        {"--allow-outside", &c.allow_outside, "Let the scene name files outside its own folder"},
    };
    for (const Option& option : program_options(c))
        options.push_back(option);
    return options;
}

void check_split(const RenderOptions& options) {
    if (options.split.pool_paths < BLOCK_PIXELS || options.split.segment_paths < 1 ||
        options.split.work_group_size < 1)
        throw InputError(fmt::format(
            "--pool-paths must be at least {}, --segment-paths and --work-group-size at least 1",
            BLOCK_PIXELS));
    int lanes = options.lanes;
    if (lanes != 0 && lanes != 1 && lanes != 8 && lanes != 16)
        throw InputError(
            fmt::format("--lanes {}: there are 1, 8 and 16 (0: what suits the device)", lanes));
    int most_streams = options.split.pool_paths / BLOCK_PIXELS;
    if (options.split.streams < 0 || options.split.streams > most_streams)
        throw InputError(fmt::format("--streams {}: there may be 1 to {}, each with at least {} of "
                                     "the pool's paths (0: what suits the device)",
                                     options.split.streams, most_streams, BLOCK_PIXELS));
}

int run_render(const RenderCommand& command) {
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

    RenderDevice& device = open_to_the_end(choose_device(command.device));
    device.compile_beside = compile_in_own_process(device.device);
    RenderResult result = render(scene, device, command.options, progress);
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
    return static_cast<int>(ExitCode::ok);
}

Subcommand render_subcommand() {
    auto c = std::make_shared<RenderCommand>();
    Subcommand render{
        .name = "render",
        .summary = "Render a scene to an .exr (linear) or .png (preview) file",
        .examples =
            "Examples:\n"
            "  parhelion render scenes/cornell-box/scene.xml -o cornell.exr --spp 256\n"
            "  parhelion render scene.xml -o preview.png --size 320x240 --spp 16 --exposure 1\n"
            "  parhelion render scene.xml -o layers.exr --aov albedo,normals,depth --stats "
            "stats.json\n"
            "  parhelion render scene.xml -o tile.exr --crop 0,0,64,64 -D light=bright --seed 7",
        .options = image_options(*c),
        .run = [c] { return run_render(*c); },
    };
    for (const Option& option : kernel_options(*c))
        render.options.push_back(option);
    for (const Option& option : pool_options(*c))
        render.options.push_back(option);
    return render;
}

} // namespace parhelion
