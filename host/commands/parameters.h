// `parhelion parameters`: every number that a scene file or the command line can give.
#pragma once

#include "host/commands/command_line.h"

#include <string>

namespace parhelion {

/// The page docs/parameters.md: each number with its domain and what happens beyond, in Markdown.
std::string parameters_page();

Subcommand parameters_subcommand();

} // namespace parhelion
