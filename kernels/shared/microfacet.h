// Microfacet distributions, GGX and Beckmann, anisotropic: density, shadowing-masking, and sampling
// of visible normals.
//
// Directions are local (normal +z), on the upper side. Shadowing-masking is the separable Smith
// form G1(wi) G1(wo), as in Mitsuba 3, so that images agree.

/// Slope squared of direction w in units of the roughness: (x^2 ax^2 + y^2 ay^2) / z^2. Infinite at
/// the horizon.
FN Real roughness_slope_squared(vec3 w, Real alpha_u, Real alpha_v) {
    return (square(alpha_u * w.x) + square(alpha_v * w.y)) / square(w.z);
}

/// GGX density of normals h (Walter et al. 2007; Heitz 2014), 1/sr. This form keeps its digits at
/// small alpha.
FN Real ggx_d(vec3 h, Real alpha_u, Real alpha_v) {
    Real x = h.x / alpha_u, y = h.y / alpha_v;
    return R(INV_PI) / (alpha_u * alpha_v * square(x * x + y * y + h.z * h.z));
}

/// Smith masking of GGX: 2 / (1 + sqrt(1 + slope^2)).
FN Real ggx_g1(vec3 w, Real alpha_u, Real alpha_v) {
    return R(2.) / (R(1.) + sqrtR(R(1.) + roughness_slope_squared(w, alpha_u, alpha_v)));
}

/// Beckmann density of normals h, 1/sr.
FN Real beckmann_d(vec3 h, Real alpha_u, Real alpha_v) {
    Real z_squared = h.z * h.z;
    Real x = h.x / alpha_u, y = h.y / alpha_v;
    Real e = exp_negative(-(x * x + y * y) / z_squared);
    return e * R(INV_PI) / (alpha_u * alpha_v * z_squared * z_squared);
}

/// Smith masking of Beckmann, the rational approximation of Walter et al. 2007 (0.35 % from the
/// exact form).
FN Real beckmann_g1(vec3 w, Real alpha_u, Real alpha_v) {
    Real slope = sqrtR(roughness_slope_squared(w, alpha_u, alpha_v));
    Real a = R(1.) / sel(slope > R(0.), slope, R(1.));
    Real g = a * (R(3.535) + R(2.181) * a) / (R(1.) + a * (R(2.276) + R(2.577) * a));
    return sel((a >= R(1.6)) | !(slope > R(0.)), R(1.), g);
}

/// A visible normal of GGX for the view direction wo, by spherical caps (Dupuy and Benyoub 2023).
/// pdf(h) = G1(wo) D(h) max(0, wo.h) / wo.z
FN vec3 ggx_sample_visible(vec3 wo, Real alpha_u, Real alpha_v, vec2 u) {
    vec3 stretched = normalize3(v3(alpha_u * wo.x, alpha_v * wo.y, wo.z));
    SinCos phi = sincos_turns(u.x);
    Real z = (R(1.) - u.y) * (R(1.) + stretched.z) - stretched.z;
    Real r = sqrt_nonnegative((R(1.) - z) * (R(1.) + z));
    vec3 half_vector = add3(v3(r * phi.cosine, r * phi.sine, z), stretched);
    // z + stretched.z = (1 - u)(1 + stretched.z) > 0: the normal is never below the horizon.
    return normalize3(v3(alpha_u * half_vector.x, alpha_v * half_vector.y,
                         (R(1.) - u.y) * (R(1.) + stretched.z)));
}

/// Asked only where HAS(beckmann). (A mask of lanes must not be combined with a plain int: 1 is no
/// mask.)
FN Mask is_beckmann(Material m) { return m.distribution != 0; }

FN Real microfacet_d(Material m, vec3 h) {
    Real d = R(0.);
    if (HAS(ggx)) d = ggx_d(h, m.alpha_u, m.alpha_v);
    if (HAS(beckmann)) {
        if (someLane(is_beckmann(m)))
            d = sel(is_beckmann(m), beckmann_d(h, m.alpha_u, m.alpha_v), d);
    }
    return d;
}

/// Masking of w for the normal h: zero where w and h see different sides of the surface.
FN Real microfacet_g1(Material m, vec3 w) {
    Real g = R(0.);
    if (HAS(ggx)) g = ggx_g1(w, m.alpha_u, m.alpha_v);
    if (HAS(beckmann)) {
        if (someLane(is_beckmann(m)))
            g = sel(is_beckmann(m), beckmann_g1(w, m.alpha_u, m.alpha_v), g);
    }
    return g;
}

typedef struct {
    vec3 h;
    Real pdf;    // of h, 1/sr
    Real weight; // G1(wo) D(h) (wo.h) / (wo.z pdf(h)): 1 for GGX
} NormalSample;

/// Both distributions are sampled by the visible normals of GGX: Beckmann's tails are lighter, so
/// that its weight D_beckmann G1_beckmann / (D_ggx G1_ggx) is bounded, and no inverse error
/// function is needed.
FN NormalSample microfacet_sample(Material m, vec3 wo, vec2 u) {
    NormalSample s;
    s.h = ggx_sample_visible(wo, m.alpha_u, m.alpha_v, u);
    s.pdf = ggx_g1(wo, m.alpha_u, m.alpha_v) * ggx_d(s.h, m.alpha_u, m.alpha_v) *
            absR(dot3(wo, s.h)) / wo.z;
    s.weight = R(1.);
    if (HAS(beckmann)) {
        if (someLane(is_beckmann(m))) {
            Real ratio = beckmann_g1(wo, m.alpha_u, m.alpha_v) *
                         beckmann_d(s.h, m.alpha_u, m.alpha_v) /
                         (ggx_g1(wo, m.alpha_u, m.alpha_v) * ggx_d(s.h, m.alpha_u, m.alpha_v));
            s.weight = sel(is_beckmann(m), ratio, R(1.));
        }
    }
    return s;
}

/// Density with which microfacet_sample returns h.
FN Real microfacet_pdf(Material m, vec3 wo, vec3 h) {
    return ggx_g1(wo, m.alpha_u, m.alpha_v) * ggx_d(h, m.alpha_u, m.alpha_v) * absR(dot3(wo, h)) /
           wo.z;
}
