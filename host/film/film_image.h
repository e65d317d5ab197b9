// From the device's film to an image.
#pragma once

#include "host/film/film_layout.h"
#include "host/flatten/scene_frame.h"
#include "host/image/image.h"

#include <vector>

namespace parhelion {

/// What 1 on the device stands for in the main layer of an image: a radiance, a length, or a part
/// of a normal.
double main_layer_unit(IntegratorKind kind, const SceneFrame& frame);

/// Divides the film's sums by the filter weights, turns what the device has in the units of `frame`
/// into the scene's own, and names the channels. `film` as the accumulate kernel leaves it.
Image film_image(const std::vector<float>& film, const FilmLayout& layout, const Scene& scene,
                 const AovPlan& aovs, const SceneFrame& frame);

} // namespace parhelion
