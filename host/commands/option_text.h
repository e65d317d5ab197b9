// What a row of an option table is called, for help, manual and completions.
#pragma once

#include "host/commands/command_line.h"

#include <string>
#include <vector>

namespace parhelion {

/// "-o", "--output"; of a positional none.
std::vector<std::string> dashed_names(const Option& option);

bool is_positional(const Option& option);
/// Whether it takes no value.
bool is_flag(const Option& option);

/// What stands for its value: "FILE", "NUMBER"; of a flag nothing, of a positional its name.
std::string value_name(const Option& option);

/// Its help, with where its number may lie.
std::string help_text(const Option& option);

} // namespace parhelion
