// Where a render tells what it has to say: --progress, --quiet, --log.
#pragma once

#include "host/commands/render.h"

namespace parhelion {

/// From its making on, messages have the form that the command asks for, to the end of the process:
/// what ends a render is told after it. The log waits until it is known that nothing reads the
/// file.
class RenderMessages {
public:
    /// Throws InputError for a log that cannot be written, or is an output or the scene.
    explicit RenderMessages(const RenderCommand& command);
    /// Where the command has come to nothing before its files were known, what waits is written
    /// too.
    ~RenderMessages();
    RenderMessages(const RenderMessages&) = delete;
    RenderMessages& operator=(const RenderMessages&) = delete;

    /// Throws InputError where the log is one of them.
    void check_distinct_from(const std::vector<UsedFile>& files) const;

private:
    std::string log_file_;
};

} // namespace parhelion
