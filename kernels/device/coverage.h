// Whether a path has met anything yet that covers its pixel: alpha, where surfaces let rays
// through.
#ifndef PARHELION_COVERAGE_H
#define PARHELION_COVERAGE_H

#include "device/path_vertex.h"

/// Paths that have met nothing yet but what let them straight through. Alpha tells: it is 0 for
/// them.
FN Mask uncovered(Results results, PathVertex v) {
    return v.active & (gather(result_channel(results, result_alpha), v.path.slot) == R(0.));
}

/// The lanes cover their pixels. What went wrong before has its own use for alpha.
FN void cover(Results results, PathVertex v, Mask lanes) {
    Real weight = gather(result_channel(results, result_weight), v.path.slot);
    Mask newly = lanes & uncovered(results, v) & (weight == weight);
    add_result(results, result_alpha, v.path.slot, R(1.), maskBits(newly));
}

/// Of the lanes, those on a surface that may let their rays straight through.
FN Mask passing_surface(Mask lanes, Material m) {
    return lanes & (((((Int)1) << m.kind) & PASSING_MATERIALS) != 0);
}

#endif
