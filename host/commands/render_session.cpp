// A session of `parhelion render`, to its end or until something stops it, and what it leaves.
#include "host/commands/render_session.h"

#include "host/cl/device.h"
#include "host/commands/bad_sample_warning.h"
#include "host/commands/duration.h"
#include "host/commands/render_outputs.h"
#include "host/json_text.h"
#include "host/memory_use.h"
#include "host/render/checkpoints.h"
#include "host/stop_signals.h"
#include "host/streams.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <limits>
#include <utility>

namespace parhelion {
namespace {

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

/// Of a film: that of a picture of 3840 x 2160, whose copy takes half a gigabyte, has it.
bool has_room_for_copy(const RenderCommand& command, const FilmContent& content) {
    constexpr std::int64_t most_sums = 100'000'000;
    const std::int64_t sums =
        std::int64_t{content.film.crop_width} * content.film.crop_height * content.channels();
    return !command.memory && sums <= most_sums;
}

/// Of a device that is gone, with what was on its film.
DeviceError failed_device(const RenderCommand& command, Checkpoints& checkpoints,
                          const cl::Error& error) {
    checkpoints.finish();
    std::error_code ignored;
    const bool kept = checkpoints.any() ||
                      (command.goes_on && std::filesystem::exists(command.checkpoint, ignored));
    const std::string file = kept ? command.checkpoint : command.resume;
    return DeviceError(fmt::format(
        "the device failed while rendering: {} in {}; {}", opencl_error_name(error.err()),
        error.what(),
        file.empty() ? "there is no checkpoint to go on from (--checkpoint)"
                     : fmt::format("--resume {} goes on from what was kept before", file)));
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

/// Writes what there is when rendering has ended; whether nothing was wrong with it.
bool write_outputs(const RenderCommand& command, const FilmHeader& header, Session& session,
                   Existing existing) {
    RenderReport report = session.report();
    // Not a matter of progress: told when quiet, too.
    bool good = report.non_finite_samples == 0;
    if (!good) say(bad_sample_warning(command, report));
    const auto start = Clock::now();
    if (writes_film(command))
        write_film(command.output, header, *session.film(), existing);
    else
        report.misfits =
            write_picture(command.output, header, *session.film(),
                          write_options(command.form, header.content, command.exposure, existing));
    good &= report.misfits.empty();
    report.write_seconds = seconds_since(start);
    report.host_peak_bytes = peak_host_bytes();
    if (!command.stats_file.empty())
        write_text_file(command.stats_file, json_text(to_json(report)),
                        existing_files(command.force || command.skip_existing));
    return good;
}

ExitCode finish_session(const RenderCommand& command, Clock::time_point started, Session& session,
                        Checkpoints& checkpoints, FilmHeader header, Existing existing) {
    const std::string reason = run(command, started, session, checkpoints);
    const bool kept = checkpoints.finish();
    header.state = session.state();
    const bool good = write_outputs(command, header, session, existing);
    if (!reason.empty()) {
        say(stopped_text(command, header, reason));
        return ExitCode::stopped;
    }
    if (!kept) return ExitCode::output_failure;
    return !good && command.strict ? ExitCode::different : ExitCode::ok;
}

} // namespace

ExitCode render_session(const RenderCommand& command, Clock::time_point started, Session& session,
                        FilmHeader header, Existing existing) {
    note_signals();
    Checkpoints checkpoints(command.checkpoint,
                            parse_duration("--checkpoint-every", command.checkpoint_every), header,
                            has_room_for_copy(command, header.content));
    try {
        return finish_session(command, started, session, checkpoints, std::move(header), existing);
    } catch (const cl::Error& error) {
        throw failed_device(command, checkpoints, error);
    }
}

} // namespace parhelion
