// From the device's film to an image.
#pragma once

#include "host/image/image.h"
#include "host/scene/scene.h"
#include "host/waves/pipeline.h"

#include <vector>

namespace parhelion {

/// What the film's channels behind the results hold: for each AOV asked for, its name, kind and
/// first channel.
struct AovLayer {
    std::string name; ///< of the EXR layer
    int kind;         ///< enum AovKind
    int channel;      ///< counted from the first AOV channel
};

struct AovPlan {
    std::vector<AovLayer> layers;
    int channels = 0;
    std::vector<AovLayer> film_layers; ///< enum FilmAovKind; they have no channel of their own
};

/// Whether an AOV is what the film itself tells of a pixel's samples (FILM_AOVS).
bool is_film_aov(const AovRequest& request);

/// Lays out the AOVs of a scene's integrator. Throws InputError for a kind that there is not,
/// naming those there are, and for a variance of one sample.
AovPlan plan_aovs(const Scene& scene);

/// Of an image with these layers: results, AOVs, second moments, spreads.
int film_channels(const Integrator& integrator, const AovPlan& aovs);

/// What 1 on the device stands for in the main layer of an image: a radiance, a length, or a part
/// of a normal.
double main_layer_unit(IntegratorKind kind, const SceneFrame& frame);

/// Divides the film's sums by the filter weights, turns what the device has in the units of `frame`
/// into the scene's own, and names the channels. `film` as the accumulate kernel leaves it.
Image film_image(const std::vector<float>& film, const WorkSizes& sizes, const Scene& scene,
                 const AovPlan& aovs, const SceneFrame& frame);

} // namespace parhelion
