// The light groups that a command line asks for.
#pragma once

#include "host/scene/scene.h"

#include <string>
#include <vector>

namespace parhelion {

/// At most so many layers of groups, of three channels each.
inline constexpr std::size_t most_light_groups = 64;

/// `asked`: NAME=ID,ID or ID each; `by_light`: a group for each emitter besides that has an id.
/// Behind them `rest`, where some emitter is in none. Throws InputError for ids that no emitter
/// has, or two groups have; for names that are twice there or no part of a layer's name; for more
/// groups than there may be; where the integrator is none of light.
std::vector<LightGroup> light_groups(const std::vector<std::string>& asked, bool by_light,
                                     const Scene& scene);

} // namespace parhelion
