// Running one stage of the kernels that are compiled as C++, in whichever precision.
#pragma once

#include "host/twin/wave_memory.h"
#include "host/twin/work_item.h"

#include <array>

namespace parhelion {

/// Of a launch, by the lists of buffers.
template<class Real>
auto buffer_ranges(const HostLaunch<Real>& launch) {
    auto range = [](const char* name, const auto& values) {
        return BufferRange{name, reinterpret_cast<std::uintptr_t>(values.data()),
                           values.size() * sizeof(values[0])};
    };
#define SCENE_RANGE(type, name) range(#name, launch.scene.name),
#define WORK_RANGE(type, name) range(#name, launch.memory.name),
    return std::array{SCENE_BUFFERS(SCENE_RANGE) WORK_BUFFERS(WORK_RANGE)};
#undef WORK_RANGE
#undef SCENE_RANGE
}

/// `Kernels`: a WorkItem that has the stages' kernels as members.
template<class Kernels, class Real>
void run_stage(Kernels& kernels, Stage stage, const HostLaunch<Real>& launch, int depth) {
#define SCENE_ARGUMENT(type, name) launch.scene.name.data(),
#define WORK_ARGUMENT(type, name) launch.memory.name.data(),
#define RUN_STAGE(name, group)                                                                     \
    case Stage::name:                                                                              \
        return kernels.name(SCENE_BUFFERS(SCENE_ARGUMENT) WORK_BUFFERS(WORK_ARGUMENT)              \
                                launch.params,                                                     \
                            launch.wave, depth);
    switch (stage) { STAGES(RUN_STAGE) }
#undef RUN_STAGE
#undef WORK_ARGUMENT
#undef SCENE_ARGUMENT
}

/// Work-item `number` of a stage, by kernels of its own.
template<class Kernels, class Real>
void run_by(Stage stage, const HostLaunch<Real>& launch, int depth, int number) {
    auto buffers = buffer_ranges(launch);
    Kernels kernels{{launch.features, number, buffers}};
    run_stage(kernels, stage, launch, depth);
}

} // namespace parhelion
