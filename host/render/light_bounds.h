// What the light tree knows of each row of the light table.
#pragma once

#include "host/render/light_tree.h"

namespace parhelion {

/// `area`: of the emitting surface, device units; 0 for a light without one. `power`: in the
/// table's unit.
LightBounds light_bounds(const LightRecord& light, double area, double power);

} // namespace parhelion
