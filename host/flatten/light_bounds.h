// What the light tree knows of each row of the light table.
#pragma once

#include "host/flatten/light_row.h"
#include "host/flatten/light_tree.h"

namespace parhelion {

LightBounds light_bounds(const LightRow& row);

} // namespace parhelion
