// `parhelion devices`: what there is to render on, and whether it works.
#pragma once

#include "host/commands/command_line.h"

namespace parhelion {

/// Its exit code is device_failure where no device passes its self-test.
Subcommand devices_subcommand();

} // namespace parhelion
