// Where a render, or a merge, tells what it has to say: --progress, --quiet, --log.
#pragma once

#include "host/commands/render.h"
#include "host/progress.h"

namespace parhelion {

/// From its making on, messages have the form that the command asks for, and go to its log, to the
/// end of the process: what ends a render is told after it.
class RenderMessages {
public:
    /// Throws InputError for a log that cannot be written, or is an output or the scene.
    explicit RenderMessages(const RenderCommand& command);
    /// The same, with what the log must not be.
    RenderMessages(const std::string& progress, bool quiet, const std::string& log_file,
                   const std::vector<UsedFile>& others);

    /// What --progress and --quiet come to.
    Progress::Mode mode() const { return mode_; }

    /// The same, with which a scene that names the log is refused; no line is added to it then.
    LoadOptions guarded(LoadOptions options) const;

    /// Throws InputError where the log is one of these files; no line is added to it then.
    void check_distinct_from(const std::vector<UsedFile>& files) const;

private:
    Progress::Mode mode_;
    std::string log_file_;
};

} // namespace parhelion
