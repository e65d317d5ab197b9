// The renders of one command line, one after the other.
#pragma once

#include "host/commands/frames.h"
#include "host/commands/shared_work.h"

namespace parhelion {

/// Renders all that are not there already; the exit code: of the first that is stopped, else the
/// largest. Throws what the first of them throws that cannot be made, or, where the command says to
/// go on, none of their InputErrors, which are told.
ExitCode render_frames(const Frames& frames, SharedWork& work);

} // namespace parhelion
