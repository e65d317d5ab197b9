// `parhelion --version`.
#pragma once

#include <string>

namespace parhelion {

/// Version, commit, and the versions of the OpenCL headers and libraries this program was built
/// with.
std::string version_text();

} // namespace parhelion
