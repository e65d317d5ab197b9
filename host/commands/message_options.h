// The options of how a subcommand tells what it has to say, the same for all that have them.
#pragma once

#include "host/commands/command_line.h"

#include <string>

namespace parhelion {

Option progress_option(std::string& progress);
Option log_option(std::string& file);
Option quiet_option(bool& quiet);

} // namespace parhelion
