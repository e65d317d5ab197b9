// The options of how a subcommand tells what it has to say, the same for all that have them.
#include "host/commands/message_options.h"

#include "host/progress.h"

namespace parhelion {

Option progress_option(std::string& progress) {
    return {"--progress",
            &progress,
            "How progress and messages are told: auto (terminal or lines), json (one object a "
            "line, for scripts), lines or terminal",
            {.words = {progress_names.begin(), progress_names.end()}}};
}

Option log_option(std::string& file) {
    return {"--log",
            &file,
            "Append to this file what standard error is told (and with --quiet what it would be), "
            "a line each with its time",
            {.kind = ValueKind::file}};
}

Option quiet_option(bool& quiet) {
    return {"-q,--quiet", &quiet, "No progress and notes; warnings and errors are told"};
}

} // namespace parhelion
