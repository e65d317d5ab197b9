// What is told of exit codes, from their list (host/error.h).
#pragma once

#include <string>

namespace parhelion {

/// The footer of --help: what the exit codes of every program mean.
std::string exit_codes_text();

/// The rows of README's table.
std::string exit_codes_table();

} // namespace parhelion
