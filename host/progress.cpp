// Telling the user where a long piece of work is.
#include "host/progress.h"

#include "host/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>

namespace parhelion {

using State = ProgressEvent::State;

Progress::Mode Progress::mode_of(const std::string& name, bool quiet) {
    if (std::find(progress_names.begin(), progress_names.end(), name) == progress_names.end())
        throw InputError(
            fmt::format("--progress '{}': there are {}", name, fmt::join(progress_names, ", ")));
    if (quiet && name != "auto")
        throw InputError(fmt::format(
            "--progress {}: with --quiet there is no progress (accepted: one of the two)", name));
    if (quiet) return Mode::quiet;
    if (name == "json") return Mode::json;
    const bool terminal = name == "auto" ? isatty(STDERR_FILENO) != 0 : name == "terminal";
    return terminal ? Mode::terminal : Mode::lines;
}

Progress::Progress(Mode mode) {
    if (mode == Mode::terminal) places_.push_back({terminal_writer()});
    if (mode == Mode::lines) places_.push_back({line_writer()});
    if (mode == Mode::json) places_.push_back({json_writer()});
    places_.push_back({log_writer()});
}

double Progress::seconds() const {
    return std::chrono::duration<double>(Clock::now() - started_).count();
}

void Progress::tell(ProgressEvent event) {
    event.part = part_, event.parts = parts_;
    const Clock::time_point now = Clock::now();
    for (Place& place : places_) {
        if (event.state == State::update && now - place.written < place.writer->interval())
            continue;
        place.writer->write(event);
        place.written = now;
    }
}

void Progress::start(const std::string& phase, const std::string& subject) {
    phase_ = phase;
    subject_ = subject;
    started_ = Clock::now();
    for (Place& place : places_)
        place.written = started_;
    tell({.state = State::start, .phase = phase_, .subject = subject_});
}

void Progress::update(double fraction, std::optional<double> rate) {
    tell({.state = State::update,
          .phase = phase_,
          .subject = subject_,
          .fraction = fraction,
          .seconds = seconds(),
          .rate = rate});
}

void Progress::finish(const std::string& remark) {
    tell({.state = State::finish,
          .phase = phase_,
          .subject = subject_,
          .message = remark,
          .fraction = 1,
          .seconds = seconds()});
}

void Progress::note(const std::string& text) {
    if (noted_.insert(text).second) tell({.state = State::note, .message = text});
}

} // namespace parhelion
