// `parhelion compile`: kernels compiled ahead of a render, or beside one.
#include "host/commands/compile.h"

#include "host/commands/cache_help.h"
#include "host/commands/render.h"
#include "host/error.h"
#include "host/flatten/device_scene.h"
#include "host/flatten/scene_features.h"
#include "host/scene/load.h"
#include "host/streams.h"
#include "host/waves/stage_programs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <memory>

namespace parhelion {
namespace {

struct CompileCommand {
    RenderCommand image; ///< of the image that the kernels are for
    std::vector<std::string> features;
    std::string program; ///< empty: all
};

constexpr const char* no_feature = "none";

FeatureSet wanted_features(const CompileCommand& c) {
    if (c.image.scene_file.empty() == c.features.empty())
        throw InputError("compile: needs a scene or --features, and not both");
    if (!c.features.empty())
        return c.features.front() == no_feature ? FeatureSet() : FeatureSet::of(c.features);
    Scene scene = load_scene(c.image.scene_file, load_options(c.image));
    apply_overrides(c.image, scene);
    return render_features(make_device_scene(scene), c.image.options);
}

std::vector<ProgramGroup> wanted_programs(const std::string& name) {
    if (name.empty()) return {program_groups.begin(), program_groups.end()};
    auto found = std::find(program_group_names.begin(), program_group_names.end(), name);
    if (found == program_group_names.end())
        throw InputError(
            fmt::format("--program {}: there are {}", name, fmt::join(program_group_names, ", ")));
    return {program_groups[found - program_group_names.begin()]};
}

int run_compile(const CompileCommand& c) {
    check_split(c.image.options);
    const Progress::Mode mode = Progress::mode_of(c.image.progress, c.image.quiet);
    tell_messages_as(mode == Progress::Mode::json ? MessageForm::json : MessageForm::text);
    Progress progress(mode);
    std::vector<ProgramGroup> programs = wanted_programs(c.program);
    progress.start("loading", c.image.scene_file);
    StageOptions options{.portable = c.image.options.portable,
                         .features = wanted_features(c),
                         .work_group_size = c.image.options.split.work_group_size};
    progress.finish(fmt::format("{}", fmt::join(options.features.names(), " ")));
    RenderDevice& device = open_to_the_end(choose_device(c.image.device));
    options.lanes = device.device.lanes(c.image.options.lanes);
    options.tracing_lanes = device.device.tracing_lanes(c.image.options.lanes);
    progress.start("compiling kernels");
    bool cached = true;
    std::vector<std::string> notes;
    if (programs.size() == 1) {
        cached = compile_program(device, programs.front(), options, notes);
    } else {
        if (several_threads()) device.compile_beside = compile_in_own_process(device.device);
        StagePrograms compiled = compile_stages(device, options);
        notes = compiled.notes;
        for (const StageReport& stage : compiled.reports)
            cached = cached && stage.cached;
    }
    progress.finish(cached ? "cached" : "compiled");
    for (const std::string& note : notes)
        progress.note("note: " + note);
    return static_cast<int>(ExitCode::ok);
}

/// The command line of run_compile for one program.
std::vector<std::string> own_command(const Device& device, ProgramGroup group,
                                     const StageOptions& options) {
    std::vector<std::string> features = options.features.names();
    if (features.empty()) features = {no_feature};
    constexpr const char* this_program = "/proc/self/exe";
    std::vector<std::string> command{this_program,
                                     "compile",
                                     "--quiet",
                                     "--program",
                                     program_group_names[static_cast<std::size_t>(group)],
                                     "--features",
                                     fmt::format("{}", fmt::join(features, ",")),
                                     "--device",
                                     std::to_string(device.index),
                                     "--lanes",
                                     std::to_string(lanes_of(group, options)),
                                     "--work-group-size",
                                     std::to_string(options.work_group_size)};
    if (options.portable) command.emplace_back("--portable");
    return command;
}

} // namespace

bool several_threads() {
    using tbb::global_control;
    return global_control::active_value(global_control::max_allowed_parallelism) > 1;
}

CompileBeside compile_in_own_process(const Device& device) {
    return [device](ProgramGroup group, const StageOptions& options,
                    const std::filesystem::path& cache_folder) {
        return ChildProcess::start(own_command(device, group, options),
                                   {"PARHELION_CACHE_DIR=" + cache_folder.string()});
    };
}

Subcommand compile_subcommand() {
    auto c = std::make_shared<CompileCommand>();
    RenderCommand& image = c->image;
    Subcommand compile{
        .name = "compile",
        .summary = "Compile a scene's kernels, so that renders find them ready",
        .examples =
            "Examples:\n"
            "  parhelion compile scenes/cornell-box/scene.xml\n"
            "  parhelion compile scene.xml --aov albedo --integrator direct   # as it will be "
            "rendered\n"
            "  parhelion compile --features \"$(parhelion info scene.xml --json | "
            "jq -r '.kernel_features | join(\",\")')\"" +
            std::string(cache_help),
        .options =
            {{"scene", &image.scene_file, "Scene file (Mitsuba 3 XML)", {.kind = ValueKind::file}},
             {"--features",
              &c->features,
              "Features of the kernels, instead of a scene's (see `parhelion info`)",
              {.delimiter = ',', .words = FeatureSet::all().names()}},
             {"--program",
              &c->program,
              fmt::format("Only this one of the programs {}", fmt::join(program_group_names, ", ")),
              {.words = {program_group_names.begin(), program_group_names.end()}}}},
        .run = [c] { return run_compile(*c); },
    };
    for (const Option& option : kernel_options(image))
        compile.options.push_back(option);
    return compile;
}

} // namespace parhelion
