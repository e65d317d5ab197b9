// Telling the user where a long piece of work is.
#pragma once

#include "host/progress_writers.h"

#include <array>
#include <chrono>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

/// What --progress accepts.
inline constexpr std::array<std::string_view, 4> progress_names{"auto", "json", "lines",
                                                                "terminal"};

/// Phases and how far they are, on standard error as the mode says, and in the log of messages
/// where there is one.
class Progress {
public:
    enum class Mode { terminal, lines, json, quiet };

    explicit Progress(Mode mode);
    /// Terminal or lines, whichever standard error is; or quiet.
    static Progress standard(bool quiet) { return Progress(mode_of("auto", quiet)); }
    /// What `name` (of progress_names) and --quiet come to. Throws InputError for another name, and
    /// where they contradict each other.
    static Mode mode_of(const std::string& name, bool quiet);

    /// What follows is of the `part`th of several renders, from 1.
    void start_part(int part, int parts) { part_ = part, parts_ = parts; }
    /// A new phase begins, e.g. "loading", of `subject`.
    void start(const std::string& phase, const std::string& subject = "");
    /// `fraction` of the phase is done, in [0, 1], at so many paths a second. Cheap enough to call
    /// often.
    void update(double fraction, std::optional<double> rate = {});
    /// The phase is over, with a closing remark (may be empty).
    void finish(const std::string& remark);
    /// A line that is no phase: a note, the same one once. Warnings are told when quiet, too
    /// (streams.h: say).
    void note(const std::string& text);

private:
    using Clock = std::chrono::steady_clock;
    struct Place {
        std::unique_ptr<ProgressWriter> writer;
        Clock::time_point written{};
    };
    double seconds() const;
    void tell(ProgressEvent event);

    std::vector<Place> places_;
    std::string phase_, subject_;
    std::set<std::string> noted_;
    int part_ = 0, parts_ = 0;
    Clock::time_point started_{};
};

} // namespace parhelion
