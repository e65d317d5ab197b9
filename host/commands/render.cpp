// `parhelion render`: a scene file to an image file.
#include "host/commands/render.h"

#include "host/clock.h"
#include "host/commands/byte_size.h"
#include "host/commands/cache_help.h"
#include "host/commands/frame_checks.h"
#include "host/commands/render_device_options.h"
#include "host/commands/render_frames.h"
#include "host/commands/render_key.h"
#include "host/commands/render_outputs.h"
#include "host/commands/render_session.h"
#include "host/commands/shared_work.h"
#include "host/commands/thread_limit.h"
#include "host/error.h"
#include "host/image/distinct_files.h"
#include "host/image/output.h"
#include "host/memory_use.h"
#include "host/progress.h"
#include "host/render/host_render.h"
#include "host/scene/load.h"
#include "host/stop_signals.h"

#include <fmt/format.h>

#include <filesystem>

namespace parhelion {
namespace {

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

/// What the next render may want takes memory of this one.
bool has_room_to_keep(const RenderCommand& command) {
    return !command.memory ||
           resident_host_bytes() < parse_byte_size("--memory", *command.memory) / 2;
}

Scene read(const RenderCommand& command, SharedWork& work) {
    LoadOptions options = work.messages.guarded(load_options(command));
    const bool keeps = work.several && has_room_to_keep(command);
    if (keeps)
        work.meshes.next_scene();
    else
        work.forget_scenes();
    options.meshes = keeps ? &work.meshes : nullptr;
    Scene scene = load_scene(command.scene_file, options);
    apply_overrides(command, scene);
    check_distinct(outputs_of(command), files_of(scene));
    note_lost_layers(command, scene);
    return scene;
}

/// The same, told.
Scene load(const RenderCommand& command, SharedWork& work) {
    Progress& progress = work.progress;
    progress.start("loading", command.scene_file);
    Scene scene = read(command, work);
    progress.finish(fmt::format("{} shapes, {}x{} pixels, {} spp", scene.shapes.size(),
                                scene.film.crop_width, scene.film.crop_height,
                                scene.sampler.samples_per_pixel));
    for (const std::string& note : scene.notes)
        progress.note("note: " + note);
    return scene;
}

RenderKey key_of(const RenderCommand& command, const Scene& scene, SharedWork& work) {
    return render_key(command, scene, &work.digests);
}

std::optional<Existing> existing_of(const RenderCommand& command, const Scene& scene,
                                    const RenderKey& key) {
    const FilmContent content = film_content(scene, plan_aovs(scene), SceneFrame{});
    return check_left_over(command, render_digest(key, scene.sampler.samples_per_pixel),
                           exr_options(command.form, content));
}

RenderDevice& device_of(const RenderCommand& command, SharedWork& work) {
    if (!work.device) {
        work.device = &open_device_of(command);
        work.device->keeps_scenes = work.several;
    }
    return *work.device;
}

OpenedRender open_where_asked(const RenderCommand& command, const Scene& scene, SharedWork& work) {
    const RenderOptions options = options_of(command);
    if (in_double(command))
        return open_on_host(scene, options, Precision::double_precision, work.progress);
    return open_on_device(scene, device_of(command, work), options, work.progress);
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
    const std::string theirs = film->header().part_name, ours = part_name(shard_of(command));
    if (!ours.empty() && theirs != ours)
        throw InputError(fmt::format("{}: is {}, not part {}", file,
                                     theirs.empty() ? "no part of a render" : "part " + theirs,
                                     ours));
    try {
        check_goes_on(film->header().state.samples, samples_per_pixel);
    } catch (const InputError& e) {
        throw InputError(file + ": " + e.what());
    }
    return film;
}

} // namespace

bool is_done(const RenderCommand& command, SharedWork& work) {
    std::error_code error;
    if (!std::filesystem::exists(command.output, error)) return false;
    const Scene scene = read(command, work);
    return !existing_of(command, scene, key_of(command, scene, work)).has_value();
}

ExitCode render_one(const RenderCommand& command, SharedWork& work) {
    const auto began = work.several ? Clock::now() : work.started;
    Progress& progress = work.progress;
    const Scene scene = load(command, work);
    const RenderKey key = key_of(command, scene, work);
    const std::optional<Existing> existing = existing_of(command, scene, key);
    if (!existing) {
        progress.note(command.output + " is there already, whole");
        return ExitCode::ok;
    }
    const auto film = film_to_go_on_from(command, key, scene.sampler.samples_per_pixel);
    const double load_seconds = seconds_since(began);
    OpenedRender opened = open_where_asked(command, scene, work);
    opened.report.load_seconds = load_seconds;
    opened.report.notes = scene.notes;
    opened.report.lenient = command.lenient;
    const FilmHeader header = header_of(command, scene, key, opened);
    Session session(std::move(opened), shard_of(command), progress);
    if (film) {
        session.take_up(*film, film->header().state);
        progress.note(fmt::format("goes on from {}, with {:.1f} % of the samples", film->name(),
                                  100 * session.share()));
    }
    if (session.all().empty()) progress.note("note: there are no samples for this part");
    const ExitCode code = render_session(command, work.started, session, header, *existing);
    progress.note("wrote " + command.output);
    return code;
}

int run_render(const RenderCommand& command) {
    const auto started = Clock::now();
    const RenderMessages messages(command);
    const Frames frames(command);
    if (command.trace) return run_trace(frames.only("--trace"), messages);
    end_on_signals();
    check_frames(frames, messages);
    const ThreadLimit threads(command.threads);
    Progress progress(messages.mode());
    SharedWork work{messages, progress, frames.several(), started};
    return static_cast<int>(render_frames(frames, work));
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
            "  parhelion render scene.xml --frames 1-100 -o 'frame-####.exr' --skip-existing\n"
            "  parhelion render scene.xml -D angle=0:10:90 -o 'angle-$angle.exr'\n"
            "  parhelion render a.xml b.xml -o '$scene.exr'\n"
            "  parhelion render scene.xml --pixel 12,34 --sample 5 --trace" +
            std::string(cache_help),
        .options = render_options(*c),
        .run = [c] { return run_render(*c); },
    };
}

} // namespace parhelion
