// With which probability each cell of a sky's image is chosen.
#pragma once

#include "host/flatten/device_scene.h"

namespace parhelion {

/// Of the image of row `texture` of the scene's textures, an envmap's.
Environment make_environment(const DeviceScene& records, int texture);

} // namespace parhelion
