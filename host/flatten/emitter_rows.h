// Rows of the light table of emitters that are no surfaces.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/flatten/light_row.h"

#include <vector>

namespace parhelion {

/// One each, in the scene's order. Throws InputError for a light whose place is no number.
std::vector<LightRow> emitter_rows(const Scene& scene, const DeviceScene& device);

} // namespace parhelion
