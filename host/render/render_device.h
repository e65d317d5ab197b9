// A device opened for rendering.
#pragma once

#include "host/cl/program.h"

#include <map>
#include <string>

namespace parhelion {

/// Context, queue, and the programs compiled so far, which later renders take over. One render at a
/// time.
struct RenderDevice {
    explicit RenderDevice(const Device& d)
        : device(d), context(d.handle), queue(context, d.handle, CL_QUEUE_PROFILING_ENABLE) {}

    Device device;
    cl::Context context;
    cl::CommandQueue queue;
    ProgramCache cache = ProgramCache::standard();
    std::map<std::string, Program> programs; ///< by key
};

} // namespace parhelion
