// The known name that a mistyped one is likely to mean.
#pragma once

#include <string>
#include <vector>

namespace parhelion {

/// Empty where none is near: at most a third of the letters are other ones.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);

} // namespace parhelion
