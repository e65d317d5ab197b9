// The buffers of kernels/device/buffers.h on a device, by name.
#pragma once

#include "host/cl/buffer.h"
#include "host/flatten/scene_arrays.h"
#include "host/waves/work_sizes.h"

#include <sys/types.h> // ulong, as the kernels call it

namespace parhelion {

#define BUFFER_MEMBER(type, name) Buffer<type> name;
struct SceneBuffers {
    SCENE_BUFFERS(BUFFER_MEMBER)
};
/// All but the film.
struct WaveBuffers {
    WAVE_BUFFERS(BUFFER_MEMBER)
    std::size_t bytes() const;
};

/// `arrays` must outlive the buffers and not change: a CPU reads large ones where they are.
SceneBuffers scene_buffers(const cl::Context& context, const cl::CommandQueue& queue,
                           const SceneArrays& arrays);

/// All zero: kernels read (and ignore) what lies behind the last path, too.
WaveBuffers wave_buffers(const cl::Context& context, const cl::CommandQueue& queue,
                         const BufferCounts& counts);

/// Binds buffers and parameters, all but the wave and the depth.
void bind_arguments(cl::Kernel& kernel, const SceneBuffers& scene, const WaveBuffers& work,
                    const Buffer<cl_uint>& film, const RenderParams& params);

/// Likewise the sizes of the buffers and where to tell of one that is left, of a checked kernel
/// (kernels/device/bounds.h).
void bind_bounds(cl::Kernel& kernel, const SceneBuffers& scene, const WaveBuffers& work,
                 const Buffer<cl_uint>& film, const Buffer<cl_uint>& outside);

/// What a checked kernel tells: the name of the buffer that it has left; null for 0, none.
const char* buffer_left(cl_uint told);

} // namespace parhelion
