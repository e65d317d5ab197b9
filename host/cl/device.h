// Finding OpenCL devices and choosing one.
#pragma once

#include "host/cl/opencl.h"

#include <cstdint>
#include <string>
#include <vector>

namespace parhelion {

/// A device and what matters for rendering on it.
struct Device {
    int index = 0; ///< in the order of `parhelion devices`
    cl::Device handle;
    std::string name, vendor, platform, driver_version, opencl_version;
    bool is_cpu = false;
    bool available = true;
    std::uint64_t memory_bytes = 0, max_allocation_bytes = 0;
    unsigned compute_units = 0;
    unsigned float_width = 1; ///< floats in a native vector
    bool fp64 = false;
    /// The driver keeps compiled programs on disk itself; asking it for a binary would make it
    /// compile every kernel once more (PoCL: for work-groups of any size).
    bool keeps_programs = false;
    /// Compiler option that makes division and square root right to the last bit, where the device
    /// can: OpenCL allows 2.5 and 3 ulp without.
    std::string rounding_option;
    /// Compiler options that only save time; what does not compile with them is compiled without.
    std::string quick_options;
    /// The driver takes calls from the program's first thread alone.
    bool one_thread = false;

    /// Values a lane-generic kernel handles at once here: 16 or 8 on CPUs, 1 elsewhere;
    /// `wanted`, where that is not 0.
    int lanes(int wanted = 0) const;
    /// Likewise, rays that kernels which walk the tree take at once. On a CPU 16 also where a
    /// register holds 8: what a packet costs by itself is shared by twice as many rays (measured on
    /// AVX2: 0.63 to 0.9 of the time of 8, while shading takes up to 1.4 times as long by 16).
    int tracing_lanes(int wanted = 0) const;
};

struct DeviceList {
    std::vector<Device> devices;
    std::size_t platforms = 0;
    std::vector<std::string> failures; ///< one line for each platform that has no device to offer
};

/// Every device of every platform. A platform that fails is reported and hides no other. Throws
/// DeviceError where there is no folder to compile in (work_folder.h).
DeviceList list_devices();

/// The device of that index or with that text in its name (case does not matter); an empty selector
/// takes the first GPU, or the first device where there is none. Throws DeviceError naming what
/// there is.
Device choose_device(const std::string& selector);

/// The name of an OpenCL error code, e.g. "CL_OUT_OF_RESOURCES (-5)".
std::string opencl_error_name(int code);

} // namespace parhelion
