// Telling the user where a long piece of work is.
#include "host/progress.h"

#include "host/safe_text.h"
#include "host/streams.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace parhelion {
namespace {

constexpr std::chrono::milliseconds terminal_interval{100};
constexpr std::chrono::seconds line_interval{5};

double seconds(std::chrono::steady_clock::duration d) {
    return std::chrono::duration<double>(d).count();
}

std::string duration_text(double s) {
    if (s < 60.0) return fmt::format("{:.0f} s", s);
    if (s < 3600.0)
        return fmt::format("{:.0f} min {:02.0f} s", std::floor(s / 60.0),
                           s - 60.0 * std::floor(s / 60.0));
    return fmt::format("{:.1f} h", s / 3600.0);
}

} // namespace

Progress Progress::standard(bool quiet) {
    if (quiet) return Progress(Mode::quiet);
    return Progress(isatty(STDERR_FILENO) ? Mode::terminal : Mode::lines);
}

void Progress::print(const std::string& text, bool last) {
    const std::string line = as_one_line(text);
    if (mode_ == Mode::terminal) {
        show(fmt::format("\r{:<{}}{}", line, width_, last ? "\n" : ""));
        width_ = last ? 0 : line.size();
    } else {
        show(line + '\n');
    }
    printed_ = Clock::now();
}

void Progress::start(const std::string& stage) {
    stage_ = stage;
    started_ = printed_ = Clock::now();
    if (mode_ == Mode::terminal) print(stage_ + " ...", false);
}

void Progress::update(double fraction, const std::string& rate) {
    if (mode_ == Mode::quiet) return;
    Clock::time_point now = Clock::now();
    if (mode_ == Mode::terminal ? now - printed_ < terminal_interval
                                : now - printed_ < line_interval)
        return;
    double elapsed = seconds(now - started_);
    std::string left =
        fraction > 0.0 ? ", " + duration_text(elapsed / fraction - elapsed) + " left" : "";
    print(fmt::format("{}: {:.0f} %{}{}{}", stage_, 100.0 * fraction, rate.empty() ? "" : ", ",
                      rate, left),
          false);
}

void Progress::finish(const std::string& remark) {
    if (mode_ == Mode::quiet) return;
    print(fmt::format("{}: {:.2f} s{}{}", stage_, seconds(Clock::now() - started_),
                      remark.empty() ? "" : ", ", remark),
          true);
}

void Progress::note(const std::string& text) {
    if (mode_ != Mode::quiet) print(text, true);
}

} // namespace parhelion
