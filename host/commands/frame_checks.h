// What can be known to be wrong with several renders before the first of them begins.
#pragma once

#include "host/commands/frames.h"
#include "host/commands/render_messages.h"

namespace parhelion {

/// Throws InputError for what cannot be, whatever the scenes; outputs that could not be written,
/// that are one file, or a file that is read; scenes that cannot be read, or do not use what they
/// are given (of each but the first, which will say so itself, at its first render).
void check_frames(const Frames& frames, const RenderMessages& messages);

/// The files that a render writes.
std::vector<UsedFile> outputs_of(const RenderCommand& command);

} // namespace parhelion
