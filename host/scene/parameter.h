// What a parameter of a plugin can be, and the value that it gives: the words of the lists in
// kernels/shared/materials.h.
#pragma once

#include "host/scene/texture.h"

namespace parhelion {

enum class MicrofacetDistribution { ggx, beckmann };
enum class WardVariant { balanced, ward, ward_duer };

namespace parameter {

/// A colour or spectrum, reduced to RGB, or a texture.
struct Color {
    using Value = Textured<Rgb>;
};

struct Number {
    using Value = double;
};

/// A number, or a texture.
struct TexturedNumber {
    using Value = Textured<double>;
};

/// A relative index of refraction: `eta`, or `specular`, which stands for one.
struct SpecularIndex {
    using Value = double;
};

struct Flag {
    using Value = bool;
};

/// Interior index of refraction over the exterior one: `int_ior`, `ext_ior`, numbers or names.
struct Index {
    using Value = double;
};

/// An index of a rough interface, whose two sides must differ.
struct SeparateIndex {
    using Value = double;
};

/// Index of a conductor relative to the exterior medium: `eta` and `k`, or the name of a
/// `material`; both over `ext_eta`, of which Mitsuba 0.x files tell.
struct ComplexIndex {
    struct Value {
        Textured<Rgb> eta{0.0},
            k{1.0}; ///< reflects everything, which is what Mitsuba 3 does by default
    };
};

/// Of microfacets: `distribution`, `alpha` or `alpha_u` and `alpha_v`.
struct Roughness {
    struct Value {
        MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
        Textured<double> alpha_u = 0.1, alpha_v = 0.1;
    };
};

/// Of microfacets that lie the same way in every direction: `distribution` and `alpha`.
struct EvenRoughness {
    struct Value {
        MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
        double alpha = 0.1;
    };
};

/// Of Ward's normals: `variant`, `alpha` or `alpha_u` and `alpha_v`.
struct WardRoughness {
    struct Value {
        WardVariant variant = WardVariant::balanced;
        Textured<double> alpha_u = 0.1, alpha_v = 0.1;
    };
};

} // namespace parameter

inline constexpr double glass_in_air = 1.5046 / 1.000277; ///< relative index of BK7
inline constexpr double plastic_in_air = 1.49 / 1.000277; ///< of polypropylene

} // namespace parhelion
