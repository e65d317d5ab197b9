// Which lobes of Burley's materials a scene needs.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/flatten/feature_decisions.h"

namespace parhelion {

/// By words of their records that are not 0; where a texture tells one, 1 stands.
void decide_principled_features(const DeviceScene& records, FeatureDecisions& out);

} // namespace parhelion
