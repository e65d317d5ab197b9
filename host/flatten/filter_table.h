// Reconstruction filters as the device reads them: tables of values, or of equally likely bins.
#pragma once

#include "host/scene/scene.h"
#include "kernels/shared/types.h"

#include <vector>

namespace parhelion {

/// Value of the filter at x pixels from its centre, along one axis, not normalised.
double filter_value(const ReconstructionFilter& filter, double x);

/// Half the width of the filter's support along one axis, pixels.
double filter_radius(const ReconstructionFilter& filter);

/// Pixels on each side that a sample counts for beside its own. 0: for its own alone, since the
/// filter is a pixel wide, or so wide (FILTER_REACH_LIMIT) that its tiles would fill the memory, or
/// is to be sampled.
int filter_reach(const Film& film);

/// The filter at n / FILTER_INTERVALS pixels from its centre, as far as any pixel within
/// FILTER_REACH_LIMIT may be from a sample. Interpolated, they are within 2e-6 of filter_value.
std::vector<float> make_filter_values(const ReconstructionFilter& filter);

/// Bins of equal mass under |filter|, and the end of the last; the weights' mean is 1.
std::vector<FilterBin> make_filter_table(const ReconstructionFilter& filter);

} // namespace parhelion
