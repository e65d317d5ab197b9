// Materials as a scene's author wrote them, from the lists in kernels/shared/materials.h.
#pragma once

#include "host/error.h"
#include "host/scene/parameter.h"
#include "kernels/shared/materials.h"

#include <string>
#include <variant>

namespace parhelion {

#define BSDF_MEMBER(Kind, name, missing, ...) parameter::Kind::Value name{missing};
#define BSDF_STRUCT(name, Name, ...)                                                               \
    struct Name##Bsdf {                                                                            \
        PARAMETERS_##name(BSDF_MEMBER)                                                             \
    };
MATERIALS(BSDF_STRUCT)

template<class, class... Kinds>
struct VariantOf {
    using Type = std::variant<Kinds...>;
};
#define BSDF_TYPE(name, Name, ...) , Name##Bsdf
using Bsdf = VariantOf<void MATERIALS(BSDF_TYPE)>::Type; ///< its index is the MaterialKind

/// Whether a texture tells how its lobe spreads, roughness or index, and not only how much it
/// reflects.
template<class Kind>
bool has_textured_lobe(const Kind& b) {
    bool textured = false;
    if constexpr (requires { b.roughness.alpha_u; })
        textured = b.roughness.alpha_u.texture || b.roughness.alpha_v.texture;
    if constexpr (requires { b.index; })
        textured = textured || b.index.eta.texture || b.index.k.texture;
    return textured;
}

/// Whether light goes through it nowhere, and it answers for its upper side alone: by its kind, or
/// by what it is told of itself.
inline bool is_opaque(const PrincipledBsdf& b) {
    return !b.spec_trans.texture && b.spec_trans.constant == 0.0;
}
inline bool is_opaque(const Bsdf& bsdf) {
    if (const auto* b = std::get_if<PrincipledBsdf>(&bsdf)) return is_opaque(*b);
    return (OPAQUE_MATERIALS >> bsdf.index()) & 1;
}

/// Whether the base below a rough coat is optically thinner than what is above it: as soon as its
/// coat loses nothing, more light leaves it than comes in.
template<class Kind>
bool has_thin_base(const Kind& b) {
    if constexpr (requires { b.nonlinear; }) return b.eta < 1.0;
    return false;
}

/// What tilts a surface's normals for one of its materials: an image of heights over it, in the
/// scene's units, or one of normals in its frame, x and y and z as 0 to 1 for -1 to 1.
struct Tilt {
    TextureUse texture; ///< null: nothing
    bool of_normals = false;
    double scale = 1.0;  ///< of heights; of normals' x and y 1, or -1 for what is seen from below
    bool flips = true;   ///< normals that would be turned away from the viewer
    bool shadows = true; ///< tilted facets shadow each other

    explicit operator bool() const { return bool(texture); }
};

struct Material {
    std::string id; ///< the author's id, or a made-up one ("bsdf 3")
    SourceLocation location;
    Bsdf bsdf;
    Tilt tilt{};
};

// What a side of a surface is made of: the number of a Material; or blend_code of that of a Blend;
// or no_material, which absorbs.
inline constexpr int no_material = -1;
constexpr int blend_code(int number) { return BLEND_CODE(number); }

/// Two in one, weighted: `second` by `weight`, `first` by the rest. A weight that is the same
/// everywhere is in (0, 1). Each is a material or again a blend.
struct Blend {
    Textured<double> weight = 0.5;
    int first = 0, second = 0;
};

} // namespace parhelion
