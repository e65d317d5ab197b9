// Samples that went wrong: the stage that first meets a number that is none says so, in the
// results of the sample; accumulate leaves it out, counts it and writes down where it was.
//
// A sample is marked by a weight that is no number. It then needs no alpha, whose place tells what
// went wrong and after how many bounces.
#ifndef PARHELION_BAD_SAMPLE_H
#define PARHELION_BAD_SAMPLE_H

/// 0 where all are finite, and no number where not; sums of it cannot overflow.
FN Real nought3(vec3 a) { return fmaR(a.x, R(0.), fmaR(a.y, R(0.), a.z * R(0.))); }

/// The lanes that are `bad` went wrong. What is known of a sample that did before stays.
FN void mark_bad(global Scalar* results, long stride, Int slot, Mask bad, int fault, int depth) {
    uint bits = maskBits(bad);
    if (!RARELY(bits)) return;
    IntLanes slots;
    slots.lanes = slot;
    for (; bits; bits &= bits - 1) {
        int place = slots.at[lowest_bit(bits)];
        global Scalar* weight = IN_BUFFER(global Scalar, results + result_weight * stride, place);
        global Scalar* alpha = IN_BUFFER(global Scalar, results + result_alpha * stride, place);
        if (*weight != *weight) continue;
        *weight = NAN;
        *alpha = (Scalar)(fault + depth * fault_count);
    }
}

#endif
