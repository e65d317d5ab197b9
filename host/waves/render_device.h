// A device opened for rendering.
#pragma once

#include "host/child_process.h"
#include "host/cl/program.h"
#include "host/cl/work_folder.h"
#include "host/flatten/device_scene.h"
#include "host/waves/stages.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace parhelion {

/// Starts a process that compiles one program for the same device and leaves it in that cache
/// folder; nothing where that cannot be.
using CompileBeside = std::function<std::optional<ChildProcess>(
    ProgramGroup, const StageOptions&, const std::filesystem::path& cache_folder)>;

/// Context, queue, and the programs compiled so far, which later renders take over. One render at a
/// time.
struct RenderDevice {
    explicit RenderDevice(const Device& d)
        : device(d), context(d.handle), queue(context, d.handle, CL_QUEUE_PROFILING_ENABLE) {}

    Device device;
    cl::Context context;
    cl::CommandQueue queue;
    ProgramCache cache = ProgramCache::standard().with_spare(spare_cache_folder(work_folder({})));
    std::map<std::string, Program> programs; ///< by key
    CompileBeside compile_beside;            ///< may be empty: all is compiled in this process
    bool saves_memory = false;               ///< compiles in processes of their own alone
    bool keeps_scenes = false;               ///< whether a render leaves texels to the next one
    std::optional<DeviceScene> scene{};      ///< those of the render before, and nothing else
};

/// For what a program does last: the process ends without closing the device, which would take the
/// compiler's memory apart first (0.1 s where kernels have been compiled).
inline RenderDevice& open_to_the_end(const Device& device) { return *new RenderDevice(device); }

} // namespace parhelion
