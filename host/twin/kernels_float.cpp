// The kernels as C++: the text that OpenCL compiles, for one lane, in single precision.
#include "host/twin/run_stage.h"
#include "host/twin/work_item.h"

#include "host/twin/opencl_names.h"

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
    run_by<Kernels>(stage, launch, depth, number);
}

} // namespace parhelion

#include "host/twin/opencl_names_end.h"
