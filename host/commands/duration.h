// Lengths of time on the command line.
#pragma once

#include <string>

namespace parhelion {

/// Seconds of "90", "90s", "1.5m" or "2h". Throws InputError, naming the option, for another text
/// and for less than 0.
double parse_duration(const std::string& option, const std::string& text);

} // namespace parhelion
