// `parhelion render`: a scene file to an image file.
#include "host/commands/render.h"

#include "host/clock.h"
#include "host/commands/bad_sample_warning.h"
#include "host/commands/cache_help.h"
#include "host/commands/compile.h"
#include "host/commands/duration.h"
#include "host/commands/misfit_warning.h"
#include "host/commands/render_key.h"
#include "host/commands/render_messages.h"
#include "host/commands/render_outputs.h"
#include "host/error.h"
#include "host/image/distinct_files.h"
#include "host/image/output.h"
#include "host/image/write_image.h"
#include "host/json_text.h"
#include "host/progress.h"
#include "host/render/checkpoints.h"
#include "host/render/host_render.h"
#include "host/scene/load.h"
#include "host/stop_signals.h"
#include "host/streams.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <filesystem>

namespace parhelion {
namespace {

std::vector<UsedFile> outputs_of(const RenderCommand& command) {
    return {{"--output", command.output},
            {"--stats", command.stats_file},
            {"--checkpoint", command.checkpoint}};
}

/// What the scene asks for and a preview does not show.
void note_lost_layers(const RenderCommand& command, Scene& scene) {
    if (writes_film(command) || image_format(command.output) != ImageFormat::png ||
        scene.integrator.aovs.empty())
        return;
    std::string names;
    for (const AovRequest& aov : scene.integrator.aovs)
        names += (names.empty() ? "" : ", ") + aov.name;
    scene.notes.push_back("a .png preview holds no layers; left out: " + names);
}

/// Must come before the first OpenCL call: the CPU device reads its environment once.
void limit_threads(int threads) {
    if (threads > 0) setenv("POCL_MAX_PTHREAD_COUNT", std::to_string(threads).c_str(), 1);
}

Scene load(const RenderCommand& command, const RenderMessages& messages, Progress& progress) {
    progress.start("loading", command.scene_file);
    Scene scene = load_scene(command.scene_file, messages.guarded(load_options(command)));
    apply_overrides(command, scene);
    check_distinct(outputs_of(command), files_of(scene));
    note_lost_layers(command, scene);
    progress.finish(fmt::format("{} shapes, {}x{} pixels, {} spp", scene.shapes.size(),
                                scene.film.crop_width, scene.film.crop_height,
                                scene.sampler.samples_per_pixel));
    for (const std::string& note : scene.notes)
        progress.note("note: " + note);
    return scene;
}

OpenedRender open_where_asked(const RenderCommand& command, const Scene& scene,
                              Progress& progress) {
    if (in_double(command))
        return open_on_host(scene, command.options, Precision::double_precision, progress);
    RenderDevice& device = open_to_the_end(choose_device(command.device));
    device.compile_beside = compile_in_own_process(device.device);
    return open_on_device(scene, device, command.options, progress);
}

/// The film to go on from, if there is one. Throws InputError where it is of another render.
std::unique_ptr<FilmFile> film_to_go_on_from(const RenderCommand& command, const RenderKey& key,
                                             int samples_per_pixel) {
    std::string file = command.resume;
    std::error_code error;
    if (command.goes_on && std::filesystem::exists(command.checkpoint, error))
        file = command.checkpoint;
    if (file.empty()) return nullptr;
    auto film = std::make_unique<FilmFile>(file);
    check_same_render(*film, key);
    try {
        check_goes_on(film->header().state.samples, samples_per_pixel);
    } catch (const InputError& e) {
        throw InputError(file + ": " + e.what());
    }
    return film;
}

FilmHeader header_of(const RenderCommand& command, const Scene& scene, const Session& session,
                     const RenderKey& key, const RenderReport& report) {
    FilmHeader header;
    header.key = key;
    header.content = session.content();
    header.blocks = session.blocks();
    header.samples_per_pixel = scene.sampler.samples_per_pixel;
    const Shard shard = shard_of(command);
    if (!shard.is_all())
        header.part_name = fmt::format("{}/{} by {}", shard.number, shard.count,
                                       sharding_names[static_cast<std::size_t>(shard.by)]);
    header.part = session.all();
    header.metadata =
        metadata_of(scene, report, render_digest(key, scene.sampler.samples_per_pixel));
    return header;
}

/// Renders until everything is on the film, or something says to stop; returns what does.
std::string run(const RenderCommand& command, Clock::time_point started, Session& session,
                Checkpoints& checkpoints) {
    const double limit = command.time_limit ? parse_duration("--time-limit", *command.time_limit)
                                            : std::numeric_limits<double>::infinity();
    std::string reason;
    const auto stop = [&] {
        reason = noted_signal();
        if (reason.empty() && seconds_since(started) >= limit) reason = "--time-limit";
        return !reason.empty() || checkpoints.due();
    };
    while (!session.finished() && reason.empty()) {
        session.step(stop);
        if (checkpoints.due() || !reason.empty() || session.groups_finished())
            checkpoints.save(session);
    }
    return session.finished() ? "" : reason;
}

/// Returns whether a value of the picture is not what it should be.
bool write_picture(const RenderCommand& command, const FilmHeader& header, Session& session,
                   Existing existing, RenderReport& report) {
    Image image = session.image();
    image.metadata = header.metadata;
    add_unfinished(header, image);
    const Film& film = header.content.film;
    report.misfits = write_image(
        command.output, image, {command.exposure.value_or(0.0), {film.component_format, existing}});
    if (report.misfits.empty()) return false;
    say(misfit_warning(command.output, film, report));
    return true;
}

std::string stopped_text(const RenderCommand& command, const FilmHeader& header,
                         const std::string& reason) {
    const double share = static_cast<double>(sample_count(header.state.samples & header.part)) /
                         static_cast<double>(sample_count(header.part));
    const std::string go_on = command.checkpoint.empty()
                                  ? "there is no checkpoint to go on from (--checkpoint)"
                                  : fmt::format("--resume {} goes on", command.checkpoint);
    return fmt::format("stopped by {} with {:.1f} % of the samples; {}", reason, 100 * share,
                       go_on);
}

} // namespace

int run_render(const RenderCommand& command) {
    const auto started = Clock::now();
    const RenderMessages messages(command);
    if (command.trace) return run_trace(command, messages);
    end_on_signals();
    check_outputs(command);
    check_distinct(outputs_of(command), {{"the scene", command.scene_file}});
    check_command(command);
    limit_threads(command.threads);
    std::optional<tbb::global_control> host_threads;
    if (command.threads > 0)
        host_threads.emplace(tbb::global_control::max_allowed_parallelism, command.threads);
    Progress progress(Progress::mode_of(command.progress, command.quiet));

    const Scene scene = load(command, messages, progress);
    const RenderKey key = render_key(command, scene);
    const Existing existing =
        check_left_over(command, render_digest(key, scene.sampler.samples_per_pixel));
    const auto film = film_to_go_on_from(command, key, scene.sampler.samples_per_pixel);
    const double load_seconds = seconds_since(started);
    OpenedRender opened = open_where_asked(command, scene, progress);
    opened.report.load_seconds = load_seconds;
    opened.report.notes = scene.notes;
    opened.report.lenient = command.lenient;
    const RenderReport begun = opened.report;
    Session session(std::move(opened), shard_of(command), progress);
    if (film) session.take_up(*film, film->header().state);
    FilmHeader header = header_of(command, scene, session, key, begun);

    note_signals();
    Checkpoints checkpoints(command.checkpoint,
                            parse_duration("--checkpoint-every", command.checkpoint_every), header);
    const std::string reason = run(command, started, session, checkpoints);
    RenderReport report = session.report();
    header.state = session.state();
    // Not a matter of progress: told when quiet, too.
    bool bad = report.non_finite_samples > 0;
    if (bad) say(bad_sample_warning(command, report));

    const auto start = Clock::now();
    if (writes_film(command))
        write_film(command.output, header, *session.film(), existing);
    else
        bad |= write_picture(command, header, session, existing, report);
    report.write_seconds = seconds_since(start);
    report.host_peak_bytes = peak_host_bytes();
    if (!command.stats_file.empty())
        write_text_file(command.stats_file, json_text(to_json(report)),
                        existing_files(command.force));
    progress.note("wrote " + command.output);
    if (!reason.empty()) say(stopped_text(command, header, reason));
    if (!reason.empty()) return static_cast<int>(ExitCode::stopped);
    if (checkpoints.failed()) return static_cast<int>(ExitCode::output_failure);
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
            "  parhelion render scene.xml -o long.exr --checkpoint long.film --continue\n"
            "  parhelion render scene.xml -o part3.film --shard 3/8\n"
            "  parhelion render scene.xml --pixel 12,34 --sample 5 --trace" +
            std::string(cache_help),
        .options = render_options(*c),
        .run = [c] { return run_render(*c); },
    };
}

} // namespace parhelion
