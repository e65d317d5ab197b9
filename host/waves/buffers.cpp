// The buffers of kernels/device/buffers.h on a device, by name.
#include "host/waves/buffers.h"

#include "host/cl/queue_end.h"
#include "host/waves/kernel_arguments.h"
#include "kernels/device/bounds.h"

#include <array>
#include <string>
#include <string_view>

namespace parhelion {

SceneBuffers scene_buffers(const cl::Context& context, const cl::CommandQueue& queue,
                           const SceneArrays& arrays) {
#define OF_ARRAY(type, name) .name = Buffer<type>::of(context, queue, #name, arrays.name),
    return {SCENE_BUFFERS(OF_ARRAY)};
}

namespace {

/// There is nothing behind what is not finite: it takes no memory but for a film that has some.
template<class T>
Buffer<T> zeroed(const cl::Context& context, const cl::CommandQueue& queue, std::string_view name,
                 std::size_t count) {
    if (name == "bad_samples") return Buffer<T>::zeros(context, queue, std::string(name), count);
    Buffer<T> buffer(context, std::string(name), count);
    buffer.fill_zero(queue);
    return buffer;
}

} // namespace

WaveBuffers wave_buffers(const cl::Context& context, const cl::CommandQueue& queue,
                         const BufferCounts& counts) {
    WaveBuffers work;
    const QueueEnd end(queue);
#define ALLOCATE(type, name) work.name = zeroed<type>(context, queue, #name, counts.name);
    WAVE_BUFFERS(ALLOCATE)
    return work;
}

std::size_t WaveBuffers::bytes() const {
#define ADD_BYTES(type, name) +name.bytes()
    return 0 WAVE_BUFFERS(ADD_BYTES);
}

void bind_arguments(cl::Kernel& kernel, const SceneBuffers& scene, const WaveBuffers& work,
                    const Buffer<cl_uint>& film, const RenderParams& params) {
    cl_uint argument = 0;
#define BIND_SCENE(type, name) kernel.setArg(argument++, scene.name.handle());
#define BIND_WAVE(type, name) kernel.setArg(argument++, work.name.handle());
    SCENE_BUFFERS(BIND_SCENE)
    WAVE_BUFFERS(BIND_WAVE)
    kernel.setArg(argument++, film.handle());
    kernel.setArg(params_argument, params);
}

void bind_bounds(cl::Kernel& kernel, const SceneBuffers& scene, const WaveBuffers& work,
                 const Buffer<cl_uint>& film, const Buffer<cl_uint>& outside) {
#define SCENE_SIZE(type, name) scene.name.bytes(),
#define WAVE_SIZE(type, name) work.name.bytes(),
    kernel.setArg(sizes_argument,
                  BufferSizes{{SCENE_BUFFERS(SCENE_SIZE) WAVE_BUFFERS(WAVE_SIZE) film.bytes()}});
    kernel.setArg(outside_argument, outside.handle());
}

const char* buffer_left(cl_uint told) {
#define BUFFER_NAME(type, name) #name,
    constexpr std::array names{SCENE_BUFFERS(BUFFER_NAME) WORK_BUFFERS(BUFFER_NAME) "no buffer"};
    return told > 0 ? names[told - 1] : nullptr;
}

} // namespace parhelion
