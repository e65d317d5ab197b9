// With which probability each cell of a sky's image is chosen.
#pragma once

#include "host/flatten/device_scene.h"

#include <limits>

namespace parhelion {

inline constexpr int all_rows = std::numeric_limits<int>::max();

/// Of the image of row `texture` of the scene's textures, an envmap's. Of the rows of cells the
/// first `lit_rows` count.
Environment make_environment(const DeviceScene& records, int texture, int lit_rows = all_rows);

} // namespace parhelion
