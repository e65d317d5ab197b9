// From the device's film to an image.
#pragma once

#include "host/film/film_layout.h"
#include "host/flatten/scene_frame.h"
#include "host/image/image.h"

#include <cstdint>
#include <span>

namespace parhelion {

/// What 1 on the device stands for in the main layer of an image: a radiance, a length, or a part
/// of a normal.
double main_layer_unit(IntegratorKind kind, const SceneFrame& frame);

/// Of `crop`, a part of the scene's film: divides its sums by the filter weights, turns what the
/// device has in the units of `frame` into the scene's own, and names the channels. `film` as the
/// accumulate kernel leaves it.
Image film_image(std::span<const std::uint32_t> film, const FilmLayout& layout, const Film& crop,
                 const Scene& scene, const AovPlan& aovs, const SceneFrame& frame);

/// Puts the rows of a band below those of the bands above it; the first one comes to an image of
/// nothing.
void append_band(Image& image, Image band);

} // namespace parhelion
