// A material as the device reads it.
#pragma once

#include "host/scene/scene.h"
#include "kernels/shared/types.h"

#include <type_traits>

namespace parhelion {

MaterialRecord material_record(const Bsdf& bsdf);

#define IS_ROUGHNESS(Kind, ...) || std::is_same_v<parameter::Kind, parameter::Roughness>
#define ROUGH_BIT(name, ...) | ((false PARAMETERS_##name(IS_ROUGHNESS)) << material_##name)
/// Bit k: material kind k has microfacets, by its parameters.
inline constexpr int rough_materials = 0 MATERIALS(ROUGH_BIT);

inline bool is_rough(const MaterialRecord& m) { return (rough_materials >> m.kind) & 1; }
/// Whether its lobes lie along a surface's texture coordinates.
inline bool is_anisotropic(const MaterialRecord& m) {
    return is_rough(m) && m.alpha_u != m.alpha_v;
}

} // namespace parhelion
