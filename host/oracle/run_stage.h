// Running one stage of the kernels that are compiled as C++, in whichever precision.
#pragma once

#include "host/oracle/wave_memory.h"

namespace parhelion {

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

} // namespace parhelion
