// A layer between OpenCL's loader and a driver (OPENCL_LAYERS names it), by which a device is full,
// lost or slow. Environment variables say how, each a whole number; what is not set changes
// nothing.
//
// FAULTY_MEMORY       bytes that the device says it has
// FAULTY_ROOM         bytes: a buffer with which all of them together are larger is refused
// FAULTY_ITEMS        a launch of more work-items is out of resources, as where a driver looks for
//                     memory only then
// FAULTY_LOST         after so many launches the device is lost: what needs it fails
// FAULTY_LOST_SILENT  likewise, but only events of kernels tell
// FAULTY_NANOSECONDS  that a launch takes for each path of its wave, by the device's clock
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl_layer.h>

#include "kernels/device/buffers.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <type_traits>

namespace {

constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();

std::uint64_t number(const char* variable) {
    const char* text = std::getenv(variable);
    return text ? std::strtoull(text, nullptr, 10) : none;
}

/// How the device fails, and what has been asked of it so far.
struct Faults {
    const std::uint64_t memory = number("FAULTY_MEMORY"), room = number("FAULTY_ROOM"),
                        items = number("FAULTY_ITEMS"), lost_after = number("FAULTY_LOST"),
                        silent_after = number("FAULTY_LOST_SILENT"),
                        nanoseconds = number("FAULTY_NANOSECONDS");
    cl_icd_dispatch driver{}, layer{};
    std::mutex mutex;
    std::map<cl_mem, std::uint64_t> buffers; ///< bytes of each
    std::uint64_t used = 0, launches = 0;
    std::map<cl_kernel, std::uint64_t> paths; ///< of its wave
    std::map<cl_event, std::uint64_t> times;  ///< nanoseconds of a launch
    std::set<cl_event> failed;

    bool lost() {
        const std::scoped_lock lock(mutex);
        return launches > lost_after;
    }
};

Faults& faults() {
    static Faults all;
    return all;
}

cl_int CL_API_CALL device_info(cl_device_id device, cl_device_info name, size_t size, void* value,
                               size_t* size_ret) {
    const cl_int result = faults().driver.clGetDeviceInfo(device, name, size, value, size_ret);
    const bool memory = name == CL_DEVICE_GLOBAL_MEM_SIZE || name == CL_DEVICE_MAX_MEM_ALLOC_SIZE;
    if (result == CL_SUCCESS && memory && value && faults().memory != none) {
        const cl_ulong bytes = faults().memory;
        std::memcpy(value, &bytes, sizeof bytes);
    }
    return result;
}

cl_mem CL_API_CALL create_buffer(cl_context context, cl_mem_flags flags, size_t size, void* memory,
                                 cl_int* error) {
    Faults& f = faults();
    const std::scoped_lock lock(f.mutex);
    if (f.used + size > f.room || f.launches > f.lost_after) {
        if (error) *error = CL_MEM_OBJECT_ALLOCATION_FAILURE;
        return nullptr;
    }
    cl_mem buffer = f.driver.clCreateBuffer(context, flags, size, memory, error);
    if (buffer) f.buffers[buffer] = size, f.used += size;
    return buffer;
}

cl_int CL_API_CALL release_buffer(cl_mem buffer) {
    Faults& f = faults();
    const std::scoped_lock lock(f.mutex);
    cl_uint references = 0;
    f.driver.clGetMemObjectInfo(buffer, CL_MEM_REFERENCE_COUNT, sizeof references, &references,
                                nullptr);
    if (references == 1)
        if (const auto known = f.buffers.find(buffer); known != f.buffers.end())
            f.used -= known->second, f.buffers.erase(known);
    return f.driver.clReleaseMemObject(buffer);
}

/// Nothing else of these kernels' arguments has the size of a wave's.
cl_int CL_API_CALL set_argument(cl_kernel kernel, cl_uint index, size_t size, const void* value) {
    WaveParams wave{};
    if (value && size == sizeof wave) {
        std::memcpy(&wave, value, sizeof wave);
        const std::scoped_lock lock(faults().mutex);
        faults().paths[kernel] = std::uint64_t{BLOCK_PIXELS} * wave.block_count * wave.sample_count;
    }
    return faults().driver.clSetKernelArg(kernel, index, size, value);
}

cl_int CL_API_CALL launch(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                          const size_t* offset, const size_t* global, const size_t* local,
                          cl_uint waits, const cl_event* wait_list, cl_event* event) {
    Faults& f = faults();
    const std::scoped_lock lock(f.mutex);
    if (f.items != none && *global > f.items) return CL_OUT_OF_RESOURCES;
    f.launches++;
    if (f.launches > f.lost_after) return CL_DEVICE_NOT_AVAILABLE;
    const bool fails = f.launches > f.silent_after;
    const cl_int result =
        fails ? f.driver.clEnqueueMarkerWithWaitList(queue, waits, wait_list, event)
              : f.driver.clEnqueueNDRangeKernel(queue, kernel, dimensions, offset, global, local,
                                                waits, wait_list, event);
    if (result == CL_SUCCESS && event) {
        if (fails) f.failed.insert(*event);
        if (f.nanoseconds != none) f.times[*event] = f.nanoseconds * f.paths[kernel];
    }
    return result;
}

cl_int CL_API_CALL event_info(cl_event event, cl_event_info name, size_t size, void* value,
                              size_t* size_ret) {
    Faults& f = faults();
    const std::scoped_lock lock(f.mutex);
    if (name == CL_EVENT_COMMAND_EXECUTION_STATUS && value && f.failed.contains(event)) {
        const cl_int status = CL_OUT_OF_RESOURCES;
        std::memcpy(value, &status, sizeof status);
        return CL_SUCCESS;
    }
    return f.driver.clGetEventInfo(event, name, size, value, size_ret);
}

cl_int CL_API_CALL profiling_info(cl_event event, cl_profiling_info name, size_t size, void* value,
                                  size_t* size_ret) {
    Faults& f = faults();
    const cl_int result = f.driver.clGetEventProfilingInfo(event, name, size, value, size_ret);
    const std::scoped_lock lock(f.mutex);
    const auto known = f.times.find(event);
    if (result == CL_SUCCESS && value && known != f.times.end()) {
        const cl_ulong time = name == CL_PROFILING_COMMAND_END ? known->second : 0;
        std::memcpy(value, &time, sizeof time);
    }
    return result;
}

/// What was under way is over all the same: it works in memory of the program's.
cl_int CL_API_CALL finish(cl_command_queue queue) {
    const cl_int result = faults().driver.clFinish(queue);
    return faults().lost() ? CL_OUT_OF_RESOURCES : result;
}

/// A call of OpenCL's that fails where the device is lost; returns an error or, last of all its
/// arguments, takes the place of one.
template<auto Member>
struct NeedsDevice;
template<class... Arguments, cl_int (CL_API_CALL* cl_icd_dispatch::*Member)(Arguments...)>
struct NeedsDevice<Member> {
    static cl_int CL_API_CALL call(Arguments... arguments) {
        return faults().lost() ? CL_DEVICE_NOT_AVAILABLE : (faults().driver.*Member)(arguments...);
    }
};

void* CL_API_CALL map_buffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking,
                             cl_map_flags flags, size_t offset, size_t size, cl_uint waits,
                             const cl_event* wait_list, cl_event* event, cl_int* error) {
    if (faults().lost()) {
        if (error) *error = CL_DEVICE_NOT_AVAILABLE;
        return nullptr;
    }
    return faults().driver.clEnqueueMapBuffer(queue, buffer, blocking, flags, offset, size, waits,
                                              wait_list, event, error);
}

} // namespace

extern "C" {

__attribute__((visibility("default"))) cl_int CL_API_CALL clGetLayerInfo(cl_layer_info name,
                                                                         size_t size, void* value,
                                                                         size_t* size_ret) {
    const cl_layer_api_version version = CL_LAYER_API_VERSION_100;
    if (name != CL_LAYER_API_VERSION) return CL_INVALID_VALUE;
    if (value && size < sizeof version) return CL_INVALID_VALUE;
    if (value) std::memcpy(value, &version, sizeof version);
    if (size_ret) *size_ret = sizeof version;
    return CL_SUCCESS;
}

__attribute__((visibility("default"))) cl_int CL_API_CALL
clInitLayer(cl_uint entries, const cl_icd_dispatch* target, cl_uint* entries_ret,
            const cl_icd_dispatch** layer) {
    Faults& f = faults();
    if (entries < sizeof(cl_icd_dispatch) / sizeof(void*)) return CL_INVALID_VALUE;
    f.driver = f.layer = *target;
    f.layer.clGetDeviceInfo = device_info;
    f.layer.clCreateBuffer = create_buffer;
    f.layer.clReleaseMemObject = release_buffer;
    f.layer.clSetKernelArg = set_argument;
    f.layer.clEnqueueNDRangeKernel = launch;
    f.layer.clGetEventInfo = event_info;
    f.layer.clGetEventProfilingInfo = profiling_info;
    f.layer.clFinish = finish;
    f.layer.clEnqueueMapBuffer = map_buffer;
    f.layer.clEnqueueReadBuffer = NeedsDevice<&cl_icd_dispatch::clEnqueueReadBuffer>::call;
    f.layer.clEnqueueWriteBuffer = NeedsDevice<&cl_icd_dispatch::clEnqueueWriteBuffer>::call;
    f.layer.clEnqueueFillBuffer = NeedsDevice<&cl_icd_dispatch::clEnqueueFillBuffer>::call;
    *entries_ret = sizeof(cl_icd_dispatch) / sizeof(void*);
    *layer = &f.layer;
    return CL_SUCCESS;
}
}
