// How kernel files are specialised.
#pragma once

#include "host/feature_set.h"

namespace parhelion {

/// Nothing of a scene's values may enter: kinds only.
struct ProgramOptions {
    int lanes = 1;
    FeatureSet features = FeatureSet::all();
    bool portable = false; ///< without x86 intrinsics
    bool checked = false;  ///< accesses ask whether they stay within their buffers; OpenCL C 2.0
};

} // namespace parhelion
