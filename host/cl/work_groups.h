// How many work-items a group may have.
#pragma once

#include "host/cl/device.h"

#include <cstddef>

namespace parhelion {

/// Of any kernel of ours, 1 or more: what the device says and, on a CPU, what the stacks of its
/// threads hold.
std::size_t largest_work_group(const Device& device);

} // namespace parhelion
