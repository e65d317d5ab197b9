// `parhelion completion` and `parhelion man`: what shells and the manual know, made from the option
// tables.
#pragma once

#include "host/commands/command_line.h"

#include <string>

namespace parhelion {

/// Scripts that complete command lines of the program.
std::string bash_completion(const CommandLine& command_line);
std::string zsh_completion(const CommandLine& command_line);

/// `command_line` gives the whole one when it is run: the subcommand is itself a part of it.
Subcommand completion_subcommand(const std::function<CommandLine()>& command_line);

} // namespace parhelion
