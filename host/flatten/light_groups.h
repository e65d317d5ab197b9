// Which of the integrator's light groups an emitter is in.
#pragma once

#include "host/scene/scene.h"

#include <initializer_list>
#include <string_view>
#include <vector>

namespace parhelion {

/// Of an emitter with these ids, of which some may be empty: the first group that names one of
/// them, else that without ids. 0 where there is no group. Throws std::logic_error where none has
/// it.
int group_of(const std::vector<LightGroup>& groups, std::initializer_list<std::string_view> ids);

/// Of an emitter that is no surface.
std::string_view id_of_emitter(const Scene& scene, std::size_t emitter);

} // namespace parhelion
