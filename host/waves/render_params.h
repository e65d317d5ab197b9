// What all kernels of a render are told.
#pragma once

#include "host/flatten/aov_plan.h"
#include "host/flatten/device_scene.h"
#include "host/waves/work_sizes.h"

namespace parhelion {

RenderParams render_params(const Scene& scene, const DeviceScene& device, const WorkSizes& sizes,
                           const AovPlan& aovs);

} // namespace parhelion
