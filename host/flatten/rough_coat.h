// What the rough coat of a plastic sends back to the base below it.
#pragma once

#include "kernels/shared/types.h"

#include <span>

namespace parhelion {

/// Of light from everywhere below. `let_through`: a row of the material's table of what the coat
/// lets through from outside. Compensated, the rest of what reciprocity lets out; otherwise, as
/// Mitsuba 3 has it: what single scattering reflects, of which its mean over 64 cosines is 1.5 %
/// too small.
double coat_inner_reflectance(const MaterialRecord& m, std::span<const float> let_through,
                              bool compensated);

} // namespace parhelion
