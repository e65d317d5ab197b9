// Materials and lights by name, in the order of their lists.
#pragma once

#include "kernels/shared/features.h"

#include <array>

namespace parhelion {

#define KIND_NAME(name, ...) #name,
inline constexpr std::array material_names{MATERIALS(KIND_NAME)};
inline constexpr std::array emitter_names{EMITTERS(KIND_NAME)};
#define KIND_PLACE(name, place) place_##place,
/// Where a ray meets an emitter of each kind.
inline constexpr std::array<EmitterPlace, emitter_kind_count> emitter_places{EMITTERS(KIND_PLACE)};

} // namespace parhelion
