// The list of all subcommands.
#pragma once

#include "host/commands/command_line.h"

namespace parhelion {

/// Each call makes new ones, with targets of their own.
std::vector<Subcommand> all_subcommands();

} // namespace parhelion
