// SIGINT and SIGTERM: what there is of a picture is kept.
#pragma once

#include <string>

namespace parhelion {

/// From now on these signals, where the caller of this program does not want them ignored, end the
/// process at once with ExitCode::stopped and a line that says so: there is nothing to be kept.
void end_on_signals();

/// The same between two renders, the one before being whole. Returns the name of the one that was
/// noted until now, or nothing.
std::string end_on_signals_again();

/// From now on the first of them is only noted, for whoever renders to ask; the next one, a
/// second or more after it, ends the process at once. Files appear whole or not at all whenever
/// that is.
void note_signals();

/// The name of the one that was noted, or nothing.
std::string noted_signal();

} // namespace parhelion
