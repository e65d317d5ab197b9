// Reconstruction filters as tables of equally likely bins.
#pragma once

#include "host/scene/scene.h"
#include "kernels/shared/types.h"

#include <vector>

namespace parhelion {

/// Value of the filter at x pixels from its centre, along one axis, not normalised.
double filter_value(const ReconstructionFilter& filter, double x);

/// Half the width of the filter's support along one axis, pixels.
double filter_radius(const ReconstructionFilter& filter);

/// Bins of equal mass under |filter|, and the end of the last; empty for the box, which needs none.
/// The weights' mean is 1.
std::vector<FilterBin> make_filter_table(const ReconstructionFilter& filter);

} // namespace parhelion
