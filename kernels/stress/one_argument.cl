// Functions of one number over a run of arguments.
#include "device/device.h"
#include "device/lanes_memory.h"

#include "stress/probe_words.h"

#include "stress/one_argument.h"

#define CHUNK 1024

#define FUNCTION_NUMBER(name, first, last, first2, last2, step) number_##name,
enum FunctionNumber { ONE_ARGUMENT_FUNCTIONS(FUNCTION_NUMBER) function_count };

/// Writes: what function `which` gives for the bits from `first` on, `step` apart. A work-item does
/// a chunk.
kernel void one_argument(global float* out, uint first, uint step, int which) {
    int begin = get_global_id(0) * CHUNK;
    for (int at = begin; at < begin + CHUNK; at += LANES) {
        Uint bits = (Uint)(first + (uint)at * step) + asUint((Int)LANE_INDEX) * step;
        Real y = R(0.);
#define CALL(name, first_, last, first2, last2, step_)                                             \
    if (which == number_##name) y = one_##name(bits);
        ONE_ARGUMENT_FUNCTIONS(CALL)
        STORE_REAL(out + at, y);
    }
}
