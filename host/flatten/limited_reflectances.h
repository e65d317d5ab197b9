// Reflectances of one material that are to be at most 1 together, where textures tell of them.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/flatten/texture_bounds.h"
#include "host/flatten/texture_images.h"
#include "host/flatten/texture_rows.h"

#include <vector>

namespace parhelion {

/// Scales the materials' records, whose rows of textures are there already. `bounds`: of each
/// texture.
void limit_reflectances(const Scene& scene, const TextureRows& rows, const Images& images,
                        const std::vector<ValueBounds>& bounds, DeviceScene& out);

} // namespace parhelion
