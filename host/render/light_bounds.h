// What the light tree knows of each row of the light table.
#pragma once

#include "host/render/light_row.h"
#include "host/render/light_tree.h"

namespace parhelion {

LightBounds light_bounds(const LightRow& row);

} // namespace parhelion
