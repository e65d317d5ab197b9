// What the samples of a wave have gathered, each in its slot; and which of them went wrong.
//
// The stage that first meets a number that is none says so in the results of the sample; accumulate
// leaves it out, counts it and writes down where it was. A sample is marked by a weight that is no
// number. It then needs no alpha, whose place tells what went wrong and after how many bounces.
#ifndef PARHELION_RESULTS_H
#define PARHELION_RESULTS_H

#include "device/lanes_memory.h"

/// Channels of a number a slot, `stride` apart: RESULT_FIELDS, then those of AOVs.
typedef struct {
    global Scalar* first;
    long stride;
} Results;

FN Results results_of(global Scalar* results, RenderParams params) {
    Results r;
    r.first = results;
    r.stride = params.result_stride;
    return r;
}

FN global Scalar* result_channel(Results r, int channel) { return r.first + channel * r.stride; }

/// Adds v to a channel of the lanes' slots.
FN void add_result(Results r, int channel, Int slot, Real v, uint bits) {
    scatter_add(result_channel(r, channel), slot, v, bits);
}
/// To three neighbouring channels.
FN void add_result3(Results r, int channel, Int slot, vec3 v, uint bits) {
    scatter_add3(result_channel(r, channel), r.stride, slot, v, bits);
}

/// To three neighbouring channels, of each lane its own; in turns, one for each channel there is.
FN void add_result3_by_lane(Results r, Int channel, Int slot, vec3 v, uint bits) {
    IntLanes channels = one_by_one(channel);
    while (bits) {
        int first = channels.at[lowest_bit(bits)];
        uint same = bits & maskBits(channel == (Int)first);
        add_result3(r, first, slot, v, same);
        bits &= ~same;
    }
}

/// 0 where all are finite, and no number where not; sums of it cannot overflow.
FN Real nought3(vec3 a) { return fmaR(a.x, R(0.), fmaR(a.y, R(0.), a.z * R(0.))); }

/// The lanes that are `bad` went wrong. What is known of a sample that did before stays.
FN void mark_bad(Results r, Int slot, Mask bad, int fault, int depth) {
    uint bits = maskBits(bad);
    if (!RARELY(bits)) return;
    IntLanes slots;
    slots.lanes = slot;
    for (; bits; bits &= bits - 1) {
        int place = slots.at[lowest_bit(bits)];
        global Scalar* weight = IN_BUFFER(global Scalar, result_channel(r, result_weight), place);
        global Scalar* alpha = IN_BUFFER(global Scalar, result_channel(r, result_alpha), place);
        if (*weight != *weight) continue;
        *weight = NAN;
        *alpha = (Scalar)(fault + depth * fault_count);
    }
}

#endif
