// Part of the row of tables that samples are drawn by.
#pragma once

#include "host/catalogue/rows.h"

namespace parhelion::stress {

/// Of every kind of filter: mass of its bins, mean weight, chi-square of offsets.
Checks filter_draws(StressRun& run);

} // namespace parhelion::stress
