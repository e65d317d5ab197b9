// Why there is no OpenCL device.
#pragma once

#include "host/cl/device.h"

#include <string>

namespace parhelion {

/// One line that says what was found where drivers are registered, loaded and asked, and what to
/// do; `list` has no device.
std::string why_no_device(const DeviceList& list);

} // namespace parhelion
