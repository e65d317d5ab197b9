// Where the kernels' common parameters (KERNEL_PARAMETERS in kernels/device/device.h) stand.
#pragma once

#include "host/cl/opencl.h"
#include "kernels/device/buffers.h"
#include "kernels/shared/types.h"

namespace parhelion {

#define COUNT_ONE(type, name) +1
inline constexpr cl_uint buffer_arguments = 0 SCENE_BUFFERS(COUNT_ONE) WORK_BUFFERS(COUNT_ONE);
inline constexpr cl_uint film_argument = buffer_arguments - 1, params_argument = buffer_arguments,
                         wave_argument = buffer_arguments + 1,
                         depth_argument = buffer_arguments + 2,
                         // Of checked kernels.
    sizes_argument = buffer_arguments + 3, outside_argument = buffer_arguments + 4;

} // namespace parhelion
