// `parhelion stress`: how accurate this build is on this machine's device.
#pragma once

#include "host/commands/command_line.h"

namespace parhelion {

Subcommand stress_subcommand();

} // namespace parhelion
