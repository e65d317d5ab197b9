// Telling the user where a long piece of work is.
#pragma once

#include <chrono>
#include <string>

namespace parhelion {

/// Stages and their percentages on standard error: one line rewritten on a terminal, plain lines
/// elsewhere, nothing if quiet.
class Progress {
public:
    enum class Mode { terminal, lines, quiet };

    explicit Progress(Mode mode) : mode_(mode) {}
    /// Terminal or lines, whichever standard error is; or quiet.
    static Progress standard(bool quiet);

    /// A new stage begins, e.g. "building the BVH".
    void start(const std::string& stage);
    /// `fraction` of the stage is done, in [0, 1]; `rate` is a remark such as "2.1 Mpaths/s". Cheap
    /// enough to call often.
    void update(double fraction, const std::string& rate);
    /// The stage is over, with a closing remark (may be empty).
    void finish(const std::string& remark);
    /// A line that is no stage: a note. Warnings are told when quiet, too (streams.h: say).
    void note(const std::string& text);

private:
    using Clock = std::chrono::steady_clock;
    void print(const std::string& text, bool last);

    Mode mode_;
    std::string stage_;
    Clock::time_point started_{}, printed_{};
    std::size_t width_ = 0; ///< of the line that stands on the terminal
};

} // namespace parhelion
