// The stress catalogue: everything that is asked of the maths, the rays and the sums, a row each.
#pragma once

#include "host/catalogue/stress_run.h"

#include <vector>

namespace parhelion::stress {

/// In the order of the report.
std::vector<Row> catalogue();

} // namespace parhelion::stress
