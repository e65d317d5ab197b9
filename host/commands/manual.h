// `parhelion man`, `parhelion-stress man`: the manual page, made from the option tables.
#pragma once

#include "host/commands/command_line.h"

#include <string>

namespace parhelion {

/// In roff, for section 1.
std::string manual_page(const CommandLine& command_line);

/// `command_line` gives the whole one when it is run: the subcommand is itself a part of it.
/// `program`: the one that it is of.
Subcommand manual_subcommand(const std::function<CommandLine()>& command_line,
                             const std::string& program = CommandLine{}.program);

} // namespace parhelion
