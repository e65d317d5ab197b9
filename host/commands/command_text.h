// Options as a shell would be given them again.
#pragma once

#include "host/commands/command_line.h"

#include <string>

namespace parhelion {

/// As a shell reads it.
std::string quoted_for_shell(const std::string& text);

/// " --name value" for an option that was given, else nothing. Flags and values that may be absent
/// only: of others nobody knows.
std::string given_option(const Option& option);

} // namespace parhelion
