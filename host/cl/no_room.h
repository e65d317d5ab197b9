// A device that has no room for what it is asked to hold.
#pragma once

#include "host/cl/opencl.h"
#include "host/error.h"

namespace parhelion {

/// Less may be asked for.
class NoRoom : public DeviceError {
public:
    using DeviceError::DeviceError;
};

/// Whether an error of OpenCL says so. Some drivers look for memory only when a buffer is first
/// used.
constexpr bool says_no_room(cl_int error) {
    return error == CL_MEM_OBJECT_ALLOCATION_FAILURE || error == CL_OUT_OF_RESOURCES ||
           error == CL_OUT_OF_HOST_MEMORY;
}

} // namespace parhelion
