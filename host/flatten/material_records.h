// A material as the device reads it.
#pragma once

#include "host/scene/scene.h"
#include "kernels/shared/types.h"

#include <algorithm>
#include <functional>
#include <type_traits>
#include <vector>

namespace parhelion {

/// Where a texture tells a value, that is 1.
MaterialRecord material_record(const Bsdf& bsdf);

/// What is left of reflectances whose sum has this largest component: where they are to be limited
/// and it is more than 1, Mitsuba 0.6 leaves 0.99 of 1.
template<class Kind>
double kept_share(const Kind& b, const Rgb& most_diffuse, const Rgb& most_specular) {
    const Rgb sum = most_diffuse + most_specular;
    const double most = std::max({sum.r, sum.g, sum.b});
    return b.ensure_energy_conservation && most > 1.0 ? 0.99 / most : 1.0;
}
/// Of a matte base and a glossy lobe.
void scale_reflectances(MaterialRecord& m, double share);

/// Fresnel reflectance of an interface of relative index eta for light that comes from everywhere
/// on its inner side. It is an integral over the side of the lesser index, where it is smooth; from
/// one side to the other by reciprocity.
double inner_reflectance(double eta);

/// The row of a texture, -1 where there is none.
using TextureRow = std::function<int(const TextureUse&)>;

#define NO_TEXTURE(type, name) -1,
inline constexpr MaterialTexturesRecord no_textures{MATERIAL_TEXTURES_FIELDS(NO_TEXTURE)};

/// Rows of the textures that tell words of the record above.
MaterialTexturesRecord material_textures(const Bsdf& bsdf, const TextureRow& row);

/// Rows of the textures that tell Burley's numbers, of words tr to kb; empty where there are none.
std::vector<int> number_rows(const Bsdf& bsdf, const TextureRow& row);

#define IS_ROUGHNESS(Kind, ...)                                                                    \
    || std::is_same_v<parameter::Kind, parameter::Roughness> ||                                    \
        std::is_same_v<parameter::Kind, parameter::EvenRoughness>
#define ROUGH_BIT(name, ...) | ((false PARAMETERS_##name(IS_ROUGHNESS)) << material_##name)
/// Bit k: material kind k has microfacets, by its parameters.
inline constexpr int rough_materials = 0 MATERIALS(ROUGH_BIT);

#define IS_INTERFACE(Kind, ...)                                                                    \
    || std::is_same_v<parameter::Kind, parameter::Index> ||                                        \
        std::is_same_v<parameter::Kind, parameter::SeparateIndex>
#define INTERFACE_BIT(name, ...) | ((false PARAMETERS_##name(IS_INTERFACE)) << material_##name)
/// Bit k: material kind k is an interface of two dielectrics, or has one.
inline constexpr int interface_materials = 0 MATERIALS(INTERFACE_BIT);

inline bool is_rough(const MaterialRecord& m) { return (rough_materials >> m.kind) & 1; }
/// Whether its words are Burley's numbers (materials.h).
inline bool is_principled(const MaterialRecord& m) {
    return m.kind == material_principled || m.kind == material_principledthin;
}
/// Whether it answers for its upper side alone.
inline bool is_opaque(const MaterialRecord& m) {
    if (m.kind == material_principled) return (m.distribution & 1) != 0;
    return (OPAQUE_MATERIALS >> m.kind) & 1;
}
/// Whether its lobes lie along a surface's texture coordinates.
inline bool is_anisotropic(const MaterialRecord& m, const MaterialTexturesRecord& t) {
    if (is_principled(m)) return m.alpha_v != 0.f; // their anisotropy
    return (is_rough(m) || m.kind == material_ward) &&
           (m.alpha_u != m.alpha_v || t.alpha_u != t.alpha_v);
}

} // namespace parhelion
