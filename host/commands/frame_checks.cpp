// What can be known to be wrong with several renders before the first of them begins.
#include "host/commands/frame_checks.h"

#include "host/commands/render_outputs.h"
#include "host/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

namespace parhelion {
namespace {

std::vector<UsedFile> scenes_of(const Frames& frames) {
    std::vector<UsedFile> scenes;
    for (const std::string& scene : frames.scenes())
        scenes.push_back({"the scene", scene});
    return scenes;
}

/// Two renders would write one file: why, as far as names say.
[[noreturn]] void refuse_same(const UsedFile& output, const Frames& frames, std::size_t first,
                              std::size_t second) {
    throw InputError(fmt::format("{} {}: is the same for {} and {} (accepted: a name of its own "
                                 "for each render, made of {}; "
                                 "a shell leaves $ alone between '')",
                                 output.role, output.name, frames.title(first),
                                 frames.title(second), fmt::join(frames.differences(), ", ")));
}

/// Of all renders, and no two the same.
std::vector<UsedFile> all_outputs(const Frames& frames) {
    std::vector<UsedFile> outputs;
    std::map<std::string, std::size_t> known;
    for (std::size_t i = 0; i < frames.count(); i++)
        for (const UsedFile& output : outputs_of(frames.command(i))) {
            if (output.name.empty()) continue;
            const auto [other, is_new] = known.emplace(output.name, i);
            if (!is_new && other->second != i) refuse_same(output, frames, other->second, i);
            outputs.push_back(output);
        }
    return outputs;
}

} // namespace

std::vector<UsedFile> outputs_of(const RenderCommand& command) {
    return {{"--output", command.output},
            {"--stats", command.stats_file},
            {"--checkpoint", command.checkpoint}};
}

void check_frames(const Frames& frames, const RenderMessages& messages) {
    if (frames.several() && !frames.command(0).resume.empty())
        throw InputError(fmt::format("--resume: goes on with one render, and there are {} "
                                     "(accepted: --checkpoint with --continue)",
                                     frames.count()));
    const std::vector<UsedFile> outputs = all_outputs(frames);
    messages.check_distinct_from(outputs);
    for (std::size_t i = 0; i < frames.count(); i++)
        check_outputs(frames.command(i));
    check_distinct(outputs, scenes_of(frames));
    for (std::size_t i = 0; i < frames.count(); i++)
        check_command(frames.command(i));
    for (std::size_t i = 1; i < frames.scenes().size(); i++) {
        const RenderCommand command = frames.command(i * frames.of_scene());
        static_cast<void>(
            scene_constructs(command.scene_file, messages.guarded(load_options(command))));
    }
}

} // namespace parhelion
