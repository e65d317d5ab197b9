// Finding OpenCL devices and choosing one.
#include "host/cl/device.h"

#include "host/cl/driver_watch.h"
#include "host/cl/no_device.h"
#include "host/cl/program_cache.h"
#include "host/cl/work_folder.h"
#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace parhelion {
namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return text;
}

Device describe(const cl::Device& handle, const std::string& platform, int index) {
    Device d;
    d.index = index;
    d.handle = handle;
    d.platform = platform;
    d.name = handle.getInfo<CL_DEVICE_NAME>();
    d.vendor = handle.getInfo<CL_DEVICE_VENDOR>();
    d.driver_version = handle.getInfo<CL_DRIVER_VERSION>();
    d.opencl_version = handle.getInfo<CL_DEVICE_VERSION>();
    d.is_cpu = (handle.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
    d.available =
        handle.getInfo<CL_DEVICE_AVAILABLE>() && handle.getInfo<CL_DEVICE_COMPILER_AVAILABLE>();
    d.memory_bytes = handle.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    d.max_allocation_bytes = handle.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    d.compute_units = handle.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    d.float_width = std::max(1u, handle.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());
    bool pocl = platform == "Portable Computing Language";
    d.keeps_programs = pocl;
    // The guard of the header with all of OpenCL's functions; lane.h declares those in use.
    if (pocl) d.quick_options = "-D_OPENCL_H_ -DDECLARE_BUILTINS";
    if (handle.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT)
        d.rounding_option = "-cl-fp32-correctly-rounded-divide-sqrt";
    d.one_thread = platform == "Oclgrind";
    d.fp64 = handle.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_fp64") != std::string::npos;
    return d;
}

/// What may be the reason that PoCL has no device.
std::string chosen_devices() {
    const char* chosen = std::getenv("POCL_DEVICES");
    return chosen ? fmt::format(" (POCL_DEVICES is '{}'; pthread and basic are the processor)",
                                as_one_line(chosen))
                  : "";
}

void add_platform(const cl::Platform& platform, DeviceList& list) {
    std::string name = platform.getInfo<CL_PLATFORM_NAME>();
    std::vector<cl::Device> handles;
    platform.getDevices(CL_DEVICE_TYPE_ALL, &handles);
    if (handles.empty())
        list.failures.push_back(fmt::format("platform {} has none{}", name, chosen_devices()));
    for (const cl::Device& handle : handles)
        list.devices.push_back(describe(handle, name, static_cast<int>(list.devices.size())));
}

std::string device_names(const DeviceList& list) {
    std::string text;
    for (const Device& d : list.devices)
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", d.index, d.name);
    return text;
}

void add_platforms(DeviceList& list) {
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error& e) {
        list.failures.push_back(
            fmt::format("no OpenCL platform: {} in {}", opencl_error_name(e.err()), e.what()));
        return;
    }
    list.platforms = platforms.size();
    for (std::size_t p = 0; p < platforms.size(); p++) {
        try {
            add_platform(platforms[p], list);
        } catch (const cl::Error& e) {
            list.failures.push_back(fmt::format("OpenCL platform {}: {} in {}", p,
                                                opencl_error_name(e.err()), e.what()));
        }
    }
}

} // namespace

int Device::lanes(int wanted) const {
    if (wanted > 0) return wanted;
    if (!is_cpu) return 1;
    return float_width >= 16 ? 16 : 8;
}

int Device::tracing_lanes(int wanted) const {
    if (wanted > 0) return wanted;
    return is_cpu && float_width >= 8 ? 16 : lanes();
}

DeviceList list_devices() {
    work_folder({ProgramCache::standard().folder()}); // before the driver asks for one
    DeviceList list;
    watch_driver("looking for devices", [&] { add_platforms(list); });
    return list;
}

Device choose_device(const std::string& selector) {
    DeviceList list = list_devices();
    if (list.devices.empty()) throw DeviceError(why_no_device(list));
    if (selector.empty()) {
        auto usable = [](const Device& d) { return d.available; };
        auto gpu = [](const Device& d) { return d.available && !d.is_cpu; };
        auto found = std::find_if(list.devices.begin(), list.devices.end(), gpu);
        if (found == list.devices.end())
            found = std::find_if(list.devices.begin(), list.devices.end(), usable);
        if (found != list.devices.end()) return *found;
        throw DeviceError("no OpenCL device is available with a compiler; found " +
                          device_names(list));
    }
    bool is_index = std::all_of(selector.begin(), selector.end(),
                                [](unsigned char c) { return std::isdigit(c); });
    for (const Device& d : list.devices) {
        bool same = is_index ? selector == std::to_string(d.index)
                             : lower(d.name).find(lower(selector)) != std::string::npos;
        if (same) return d;
    }
    throw DeviceError(fmt::format("--device '{}' fits no OpenCL device; there are {}", selector,
                                  device_names(list)));
}

std::string opencl_error_name(int code) {
    switch (code) {
#define ERROR_NAME(name)                                                                           \
    case name:                                                                                     \
        return fmt::format(#name " ({})", code);
        ERROR_NAME(CL_DEVICE_NOT_FOUND)
        ERROR_NAME(CL_DEVICE_NOT_AVAILABLE)
        ERROR_NAME(CL_COMPILER_NOT_AVAILABLE)
        ERROR_NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE)
        ERROR_NAME(CL_OUT_OF_RESOURCES)
        ERROR_NAME(CL_OUT_OF_HOST_MEMORY)
        ERROR_NAME(CL_BUILD_PROGRAM_FAILURE)
        ERROR_NAME(CL_INVALID_VALUE)
        ERROR_NAME(CL_INVALID_DEVICE)
        ERROR_NAME(CL_INVALID_BINARY)
        ERROR_NAME(CL_INVALID_BUILD_OPTIONS)
        ERROR_NAME(CL_INVALID_KERNEL_NAME)
        ERROR_NAME(CL_INVALID_KERNEL_ARGS)
        ERROR_NAME(CL_INVALID_ARG_INDEX)
        ERROR_NAME(CL_INVALID_ARG_SIZE)
        ERROR_NAME(CL_INVALID_WORK_GROUP_SIZE)
        ERROR_NAME(CL_INVALID_GLOBAL_WORK_SIZE)
        ERROR_NAME(CL_INVALID_BUFFER_SIZE)
        ERROR_NAME(CL_PLATFORM_NOT_FOUND_KHR)
#undef ERROR_NAME
    default:
        return fmt::format("OpenCL error {}", code);
    }
}

} // namespace parhelion
