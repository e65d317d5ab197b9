// `parhelion stress` at work.
#pragma once

#include "host/commands/stress.h"

namespace parhelion::stress {

/// Returns the exit code.
int run_catalogue(const StressCommand& command);

} // namespace parhelion::stress
