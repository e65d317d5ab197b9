// Device memory of one element type.
#pragma once

#include "host/cl/opencl.h"
#include "host/error.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace parhelion {

/// `count` values of T on the device. Never empty there: a kernel may always be given a pointer.
template<class T>
class Buffer {
public:
    Buffer() = default;

    /// Memory whose contents are undefined. Throws DeviceError, naming the buffer and its size,
    /// where it does not fit.
    Buffer(const cl::Context& context, const std::string& name, std::size_t count) : count_(count) {
        std::size_t size = bytes() > 0 ? bytes() : sizeof(T);
        try {
            handle_ = cl::Buffer(context, CL_MEM_READ_WRITE, size);
        } catch (const cl::Error&) {
            throw DeviceError(
                fmt::format("the device has no room for buffer {} of {:.1f} MB", name, size / 1e6));
        }
    }

    /// A copy of host values.
    Buffer(const cl::Context& context, const cl::CommandQueue& queue, const std::string& name,
           const T* values, std::size_t count)
        : Buffer(context, name, count) {
        if (count_ > 0) queue.enqueueWriteBuffer(handle_, CL_TRUE, 0, bytes(), values);
    }

    void fill_zero(const cl::CommandQueue& queue) const {
        if (count_ > 0) queue.enqueueFillBuffer(handle_, cl_uchar{0}, 0, bytes());
    }
    void read(const cl::CommandQueue& queue, T* values) const {
        if (count_ > 0) queue.enqueueReadBuffer(handle_, CL_TRUE, 0, bytes(), values);
    }

    const cl::Buffer& handle() const { return handle_; }
    std::size_t count() const { return count_; }
    std::size_t bytes() const { return count_ * sizeof(T); }

private:
    cl::Buffer handle_;
    std::size_t count_ = 0;
};

} // namespace parhelion
