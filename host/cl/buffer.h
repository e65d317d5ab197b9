// Device memory of one element type.
#pragma once

#include "host/cl/no_room.h"
#include "host/cl/opencl.h"
#include "host/large_vector.h"
#include "host/zero_pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace parhelion {

/// Whether the context's device is a CPU, whose memory is the host's.
inline bool shares_host_memory(const cl::Context& context) {
    auto device = context.getInfo<CL_CONTEXT_DEVICES>().front();
    return (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
}

/// `count` values of T on the device. Never empty there: a kernel may always be given a pointer.
///
/// A CPU works in memory allocated here, because drivers do not ask for huge pages (measured: with
/// them the second bounce through 3 M triangles is a tenth faster).
template<class T>
class Buffer {
public:
    Buffer() = default;

    /// Memory whose contents are undefined. Throws NoRoom, naming the buffer and its size,
    /// where it does not fit.
    Buffer(const cl::Context& context, const std::string& name, std::size_t count) : count_(count) {
        try {
            if (shares_host_memory(context)) memory_.resize(places());
            handle_ = memory_.empty() ? cl::Buffer(context, CL_MEM_READ_WRITE, places() * sizeof(T))
                                      : over(context, CL_MEM_READ_WRITE, memory_.data());
        } catch (const cl::Error&) {
            refuse(name);
        } catch (const std::bad_alloc&) {
            refuse(name);
        } catch (const std::length_error&) {
            refuse(name);
        }
    }

    /// A copy of host values.
    Buffer(const cl::Context& context, const cl::CommandQueue& queue, const std::string& name,
           const T* values, std::size_t count)
        : Buffer(context, name, count) {
        write(queue, values);
    }

    /// Host values that kernels only read: a CPU reads them where they are, if they begin with a
    /// cache line, as those of a LargeVector do; others get a copy. `values` must outlive the
    /// buffer and not change.
    static Buffer of(const cl::Context& context, const cl::CommandQueue& queue,
                     const std::string& name, std::span<const T> values) {
        bool in_lines =
            reinterpret_cast<std::uintptr_t>(values.data()) % LargeAllocator<T>::cache_line == 0;
        if (values.empty() || !in_lines || !shares_host_memory(context))
            return Buffer(context, queue, name, values.data(), values.size());
        Buffer buffer;
        buffer.count_ = values.size();
        // OpenCL takes no pointer to const; the flag promises that nothing is written.
        buffer.handle_ = buffer.over(context, CL_MEM_READ_ONLY, const_cast<T*>(values.data()));
        return buffer;
    }

    /// Zeros. On a CPU there is no memory behind what nothing has been written to.
    static Buffer zeros(const cl::Context& context, const cl::CommandQueue& queue,
                        const std::string& name, std::size_t count) {
        if (!shares_host_memory(context)) {
            Buffer buffer(context, name, count);
            buffer.fill_zero(queue);
            queue.finish();
            return buffer;
        }
        Buffer buffer;
        buffer.count_ = count;
        try {
            buffer.pages_ = zero_pages(buffer.places() * sizeof(T));
            buffer.handle_ =
                buffer.over(context, CL_MEM_READ_WRITE, static_cast<T*>(buffer.pages_.get()));
        } catch (const cl::Error&) {
            buffer.refuse(name);
        } catch (const std::bad_alloc&) {
            buffer.refuse(name);
        }
        return buffer;
    }

    Buffer(Buffer&& other) noexcept = default;
    Buffer& operator=(Buffer&& other) noexcept {
        // The handle goes before the memory that it is over.
        handle_ = std::exchange(other.handle_, {});
        memory_ = std::move(other.memory_);
        pages_ = std::move(other.pages_);
        count_ = std::exchange(other.count_, 0);
        return *this;
    }
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer() = default;

    void fill_zero(const cl::CommandQueue& queue) const {
        if (count_ > 0) queue.enqueueFillBuffer(handle_, cl_uchar{0}, 0, bytes());
    }
    /// Zeros again, of one made by zeros(); nothing may be under way.
    void zero_again(const cl::CommandQueue& queue) const {
        if (pages_) return forget(pages_);
        fill_zero(queue);
        queue.finish();
    }
    void write(const cl::CommandQueue& queue, const T* values) const {
        if (count_ > 0) queue.enqueueWriteBuffer(handle_, CL_TRUE, 0, bytes(), values);
    }
    void read(const cl::CommandQueue& queue, T* values) const {
        if (count_ > 0) queue.enqueueReadBuffer(handle_, CL_TRUE, 0, bytes(), values);
    }
    /// `count` values from the `first` on.
    void read(const cl::CommandQueue& queue, std::size_t first, std::size_t count,
              T* values) const {
        if (count > 0)
            queue.enqueueReadBuffer(handle_, CL_TRUE, first * sizeof(T), count * sizeof(T), values);
    }

    const cl::Buffer& handle() const { return handle_; }
    std::size_t count() const { return count_; }
    std::size_t bytes() const { return count_ * sizeof(T); }

private:
    std::size_t places() const { return std::max<std::size_t>(count_, 1); }

    cl::Buffer over(const cl::Context& context, cl_mem_flags access, T* memory) const {
        return {context, access | CL_MEM_USE_HOST_PTR, places() * sizeof(T), memory};
    }

    [[noreturn]] void refuse(const std::string& name) const {
        throw NoRoom(fmt::format("the device has no room for buffer {} of {:.1f} MB", name,
                                 static_cast<double>(bytes()) / 1e6));
    }

    // What the handle is over, where it is the buffer's own: one of them.
    LargeVector<T> memory_;
    ZeroPages pages_;
    cl::Buffer handle_;
    std::size_t count_ = 0;
};

/// A buffer's values for as long as it lives, to be read (const T) or written as well: of a CPU's
/// where they are, of others a copy. No kernel may use the buffer meanwhile.
template<class T>
class BufferView {
public:
    BufferView(const cl::CommandQueue& queue, const Buffer<std::remove_const_t<T>>& buffer)
        : queue_(queue), handle_(buffer.handle()),
          values_(
              static_cast<T*>(queue.enqueueMapBuffer(
                  handle_, CL_TRUE, std::is_const_v<T> ? CL_MAP_READ : CL_MAP_READ | CL_MAP_WRITE,
                  0, buffer.bytes())),
              buffer.count()) {}
    ~BufferView() {
        cl_event done = nullptr;
        if (clEnqueueUnmapMemObject(queue_(), handle_(),
                                    const_cast<std::remove_const_t<T>*>(values_.data()), 0, nullptr,
                                    &done) == CL_SUCCESS) {
            clWaitForEvents(1, &done); // what ends a device that is lost is told elsewhere
            clReleaseEvent(done);
        }
    }
    BufferView(const BufferView&) = delete;
    BufferView& operator=(const BufferView&) = delete;

    std::span<T> values() const { return values_; }

private:
    cl::CommandQueue queue_;
    cl::Buffer handle_;
    std::span<T> values_;
};

} // namespace parhelion
