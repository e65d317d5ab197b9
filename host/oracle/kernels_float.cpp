// The kernels as C++: the text that OpenCL compiles, for one lane, in single precision.
#include "host/oracle/wave_memory.h"
#include "host/oracle/work_item.h"

#include "host/oracle/opencl_names.h"

namespace parhelion {
namespace {

struct Kernels : WorkItem {
    // Of a walk's keys: an Int that holds the bits of a Real.
    // NOLINTNEXTLINE(readability-identifier-naming): the kernels' name
    static int asInt(float x) { return std::bit_cast<int>(x); }

#define PARHELION_REAL float
#include "kernels/accumulate.cl"
#include "kernels/generate.cl"
#include "kernels/intersect.cl"
#include "kernels/shade.cl"
#include "kernels/shadow.cl"
#undef PARHELION_REAL
};

} // namespace

void run_work_item(Stage stage, const HostLaunch<float>& launch, int depth, int number) {
    Kernels kernels{{launch.features, number}};
#define SCENE_ARGUMENT(type, name) launch.scene.name.data(),
#define WORK_ARGUMENT(type, name) launch.memory.name.data(),
#define RUN_STAGE(name, group)                                                                     \
    case Stage::name:                                                                              \
        return kernels.name(SCENE_BUFFERS(SCENE_ARGUMENT) WORK_BUFFERS(WORK_ARGUMENT)              \
                                launch.params,                                                     \
                            launch.wave, depth);
    switch (stage) { STAGES(RUN_STAGE) }
}

} // namespace parhelion

#include "host/oracle/opencl_names_end.h"
