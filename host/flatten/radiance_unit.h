// The unit that the device adds up light in: radiance that single precision cannot add up, or
// hardly holds, is scaled by a power of two on the way there and back.
#pragma once

#include "host/flatten/light_row.h"

#include <span>

namespace parhelion {

/// Power of two: radiance of the scene that is 1 on the device. Everything the film adds up is
/// linear in it (second moments and variances in its square), so the bits of an image are the same
/// in any unit that nothing leaves the range of single precision in.
///
/// It is 1 for all but extreme scenes: while the brightest light has a radiance (one without size:
/// an irradiance in the scene, at most from one unit of the device away) of 2^-40 to 2^40. Where
/// all are dimmer, the brightest becomes 2^-20: a point may be nearer than a unit. Where one is
/// brighter, that one becomes 2^40, whose square can be added up 2^30 times with room for samples
/// 2^8 times as large; or as much more, up to 2^80, that what the lights bring across the scene
/// stays above 2^-40: a lamp too small to be seen may have any radiance.
double radiance_unit(std::span<const LightRow> rows);

} // namespace parhelion
