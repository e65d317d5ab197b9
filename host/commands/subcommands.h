// The list of all subcommands, and the command line of the program.
#pragma once

#include "host/commands/command_line.h"

namespace parhelion {

/// Each call makes new ones, with targets of their own.
std::vector<Subcommand> all_subcommands();

/// All that `parhelion` understands.
CommandLine program_command_line();

} // namespace parhelion
