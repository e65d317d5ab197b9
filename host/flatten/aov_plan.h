// What a scene asks the film to hold beside its picture.
#pragma once

#include "host/scene/scene.h"
#include "kernels/shared/features.h"
#include "kernels/shared/types.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

/// A kind of AOV: its name, how many channels it takes, and their names' ends in the image.
struct AovKindInfo {
    std::string_view name;
    int channels;
    std::string_view suffixes;
};
#define AOV_INFO(name, channels, suffixes) AovKindInfo{#name, channels, suffixes},
inline constexpr std::array aov_kinds{AOVS(AOV_INFO)};
static_assert(aov_kinds.size() <= AOV_LIMIT);
inline constexpr std::array film_aov_kinds{FILM_AOVS(AOV_INFO)};

/// Whether the values of a kind are numbers of things, whose suffix says so.
constexpr bool holds_whole_numbers(const AovKindInfo& kind) {
    return kind.suffixes == "I" || kind.suffixes == "N";
}

/// What the film's channels behind the results hold: for each AOV asked for, its name, kind and
/// first channel.
struct AovLayer {
    std::string name; ///< of the EXR layer
    int kind;         ///< enum AovKind
    int channel;      ///< counted from the first AOV channel
};

/// What a group of emitters sends, in r, g, b.
struct LightGroupLayer {
    std::string name; ///< of the EXR layer
    int channel;      ///< counted from the first AOV channel
};

struct AovPlan {
    std::vector<AovLayer> layers;
    std::vector<LightGroupLayer> light_groups; ///< those of the integrator
    int channels = 0;
    std::vector<AovLayer> film_layers; ///< enum FilmAovKind; they have no channel of their own
};

/// Whether an AOV is what the film itself tells of a pixel's samples (FILM_AOVS).
bool is_film_aov(const AovRequest& request);
/// Or else what is seen first.
inline bool is_first_hit_aov(const AovRequest& request) { return !is_film_aov(request); }

/// Lays out the AOVs of a scene's integrator. Throws InputError for a kind that there is not,
/// naming those there are, and for a variance of one sample.
AovPlan plan_aovs(const Scene& scene);

} // namespace parhelion
