// The kernels' shared maths as C++: namespace f32 is the device's arithmetic, f64 the same formulas
// in double.
#pragma once

#include "host/feature_set.h"
#include "kernels/shared/features.h"
#include "kernels/shared/types.h"

// Before the kernels make R a macro: GLM has types of that name, wherever else it is included.
#include <glm/matrix.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter" // every BSDF and emitter has the same signature
#ifdef __clang__
#pragma GCC diagnostic ignored                                                                     \
    "-Wbitwise-instead-of-logical" // masks are vectors elsewhere: & and | only
#pragma GCC diagnostic ignored "-Wunused-function"
#endif

#define FEATURES (FeatureSet::all())

namespace parhelion::f32 {
#define PARHELION_REAL float
#include "kernels/shared/shared.h"
#undef PARHELION_REAL
} // namespace parhelion::f32

namespace parhelion::f64 {
#define PARHELION_REAL double
#define PARHELION_REAL_IS_DOUBLE
#include "kernels/shared/shared.h"
#undef PARHELION_REAL
#undef PARHELION_REAL_IS_DOUBLE
} // namespace parhelion::f64

#pragma GCC diagnostic pop
