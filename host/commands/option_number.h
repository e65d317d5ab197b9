// The number of an option, out of its text.
#pragma once

#include "host/commands/command_line.h"

#include <string>

namespace parhelion {

/// Whole numbers may be written as 1e3. Throws InputError that names the option, what was found and
/// what is accepted.
double option_number(const Option& option, const std::string& text);

/// The last of an option's names, without what says that a flag clears.
std::string option_name(const Option& option);

} // namespace parhelion
