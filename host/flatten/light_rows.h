// Rows of the light table: one for every emitting primitive (two triangles that are a
// parallelogram are one) and every other emitter.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/flatten/light_row.h"

#include <vector>

namespace parhelion {

/// In the order of shapes, then emitters; radiance in the scene's own unit. Rows that give no light
/// are left out. Appends to `notes` what the user should know of emitters that are lost. Throws
/// InputError for a light whose place is no number.
std::vector<LightRow> light_rows(const Scene& scene, const DeviceScene& device,
                                 std::vector<std::string>& notes);

} // namespace parhelion
