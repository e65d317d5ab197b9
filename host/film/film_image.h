// From the film's sums to an image.
#pragma once

#include "host/film/film_content.h"
#include "host/film/film_sums.h"
#include "host/image/image.h"

namespace parhelion {

/// What 1 on the device stands for in the main layer of an image: a radiance, a length, or a part
/// of a normal.
double main_layer_unit(IntegratorKind kind, const SceneFrame& frame);

/// Divides the sums by the filter weights, turns what the device has in units of its own into the
/// scene's, and names the channels.
Image film_image(const FilmSums& sums, const FilmContent& content);

} // namespace parhelion
