// The renders of one command line, one after the other.
#include "host/commands/render_frames.h"

#include "host/commands/duration.h"
#include "host/error.h"
#include "host/scene/text.h"
#include "host/stop_signals.h"
#include "host/streams.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion {
namespace {

/// Each line of what is wrong says with which render, where there are several.
InputError of_render(const InputError& error, const Frames& frames, std::size_t number) {
    if (!frames.several()) return error;
    std::vector<std::string> lines;
    for (const std::string_view line : split(error.what(), "\n"))
        lines.push_back(fmt::format("{} (render {} of {}: {})", line, number + 1, frames.count(),
                                    frames.title(number)));
    return InputError(lines);
}

/// All outputs that are there are looked at before anything is rendered.
std::vector<std::size_t> left_to_render(const Frames& frames, SharedWork& work) {
    std::vector<std::size_t> left;
    left.reserve(frames.count());
    const RenderCommand first = frames.command(0);
    const bool may_be_there = first.skip_existing || (first.goes_on && !first.force);
    if (may_be_there) work.progress.start("looking at what is there");
    for (std::size_t i = 0; i < frames.count(); i++) {
        try {
            if (!may_be_there || !is_done(frames.command(i), work)) left.push_back(i);
        } catch (const InputError& error) {
            if (!first.keep_going) throw of_render(error, frames, i);
            left.push_back(i); // told when its turn comes
        }
        if (may_be_there)
            work.progress.update(static_cast<double>(i + 1) / static_cast<double>(frames.count()));
    }
    if (may_be_there)
        work.progress.finish(fmt::format("{} of {} renders are whole", frames.count() - left.size(),
                                         frames.count()));
    return left;
}

/// What says that no other render may begin; from now on it ends the process at once, until the
/// next one has something to keep.
std::string stopped_between(const RenderCommand& command, const SharedWork& work) {
    std::string reason = end_on_signals_again();
    if (reason.empty() && command.time_limit &&
        seconds_since(work.started) >= parse_duration("--time-limit", *command.time_limit))
        reason = "--time-limit";
    return reason;
}

/// With --keep-going what is wrong with the scene is told here.
ExitCode render_or_tell(const Frames& frames, std::size_t number, SharedWork& work) {
    const RenderCommand command = frames.command(number);
    try {
        return render_one(command, work);
    } catch (const InputError& error) {
        const InputError told = of_render(error, frames, number);
        if (!command.keep_going) throw told;
        for (const std::string_view line : split(told.what(), "\n"))
            say("parhelion: " + std::string(line));
        return ExitCode::bad_input;
    }
}

/// `reason`: of a stop between two renders; else that has been said.
std::string stopped_text(const Frames& frames, std::size_t number, std::size_t whole,
                         const std::string& reason) {
    const bool has_checkpoint = !frames.command(number).checkpoint.empty();
    return fmt::format("{}{} of {} renders are whole; the same command with --skip-existing{} goes "
                       "on",
                       reason.empty() ? "" : fmt::format("stopped by {}; ", reason), whole,
                       frames.count(), has_checkpoint ? " --continue" : "");
}

} // namespace

ExitCode render_frames(const Frames& frames, SharedWork& work) {
    if (!frames.several()) return render_or_tell(frames, 0, work);
    const std::vector<std::size_t> left = left_to_render(frames, work);
    std::size_t whole = frames.count() - left.size();
    ExitCode worst = ExitCode::ok;
    std::string reason;
    for (const std::size_t number : left) {
        work.progress.start_part(static_cast<int>(number + 1), static_cast<int>(frames.count()));
        ExitCode code = ExitCode::stopped;
        if (number != left.front()) reason = stopped_between(frames.command(number), work);
        if (reason.empty()) code = render_or_tell(frames, number, work);
        worst = std::max(worst, code);
        if (code == ExitCode::stopped) {
            say(stopped_text(frames, number, whole, reason));
            return code;
        }
        whole += code == ExitCode::bad_input ? 0 : 1;
    }
    return worst;
}

} // namespace parhelion
