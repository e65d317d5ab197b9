// What all kernels of a render are told.
#pragma once

#include "host/waves/wave_stream.h"

namespace parhelion {

RenderParams render_params(const Scene& scene, const DeviceScene& device, const WorkSizes& sizes,
                           const AovPlan& aovs);

} // namespace parhelion
