// Which features textures need.
#pragma once

#include "host/flatten/device_scene.h"

namespace parhelion {

/// Read off the records of textures, and of what they tell of materials.
void decide_texture_features(const DeviceScene& records, FeatureDecisions& out);

} // namespace parhelion
