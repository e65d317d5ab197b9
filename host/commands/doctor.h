// `parhelion doctor`: everything about this machine that a bug report should say.
#pragma once

#include "host/commands/command_line.h"

namespace parhelion {

/// Its exit code is device_failure where a render would not work.
Subcommand doctor_subcommand();

} // namespace parhelion
