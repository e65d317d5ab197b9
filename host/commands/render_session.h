// A session of `parhelion render`, to its end or until something stops it, and what it leaves.
#pragma once

#include "host/clock.h"
#include "host/commands/render.h"
#include "host/error.h"
#include "host/film/film_file.h"
#include "host/image/output.h"
#include "host/render/session.h"

namespace parhelion {

/// Renders until everything is on the film, or a signal or --time-limit, which counts from
/// `started`, says to stop; keeps checkpoints meanwhile, and writes the output. `header`: of the
/// film but for its state; `existing`: of the output. Throws OutputError.
ExitCode render_session(const RenderCommand& command, Clock::time_point started, Session& session,
                        FilmHeader header, Existing existing);

} // namespace parhelion
