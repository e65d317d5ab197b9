// Does a device compute what it should?
#pragma once

#include "host/cl/device.h"

#include <string>

namespace parhelion {

/// Compiles and runs a small kernel with known results. Returns an empty string, or one line that
/// says what went wrong.
std::string self_test(const Device& device);

} // namespace parhelion
