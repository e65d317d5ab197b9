// GGX, anisotropic (Walter et al. 2007; Heitz 2014): density of normals, shadowing-masking, and
// sampling of visible normals; and what Beckmann shares with it.
//
// Directions are local (normal +z), on the upper side.

/// Length of w stretched by the roughness, which for a direction of the slope t (in units of the
/// roughness) is w.z sqrt(1 + t^2).
FN Real stretched_length(vec3 w, Real alpha_u, Real alpha_v) {
    return length3(v3(alpha_u * w.x, alpha_v * w.y, w.z));
}

/// (h.x^2 / au^2 + h.y^2 / av^2) au av + rest. Divides nothing where the roughness is isotropic,
/// else adds what the quotients were rounded by; the larger square comes last, where it is rounded
/// once less.
FN Real add_roughness_scaled_square(vec3 h, Real alpha_u, Real alpha_v, Real rest) {
    Real small = h.x, large = h.y, small_scaled = h.x, large_scaled = h.y;
    if (HAS(anisotropy)) {
        TwoReal x = two_scaled(h.x, alpha_v, alpha_u), y = two_scaled(h.y, alpha_u, alpha_v);
        Mask ordered = x.high * h.x < y.high * h.y;
        small = sel(ordered, h.x, h.y), large = sel(ordered, h.y, h.x);
        small_scaled = sel(ordered, x.high, y.high), large_scaled = sel(ordered, y.high, x.high);
        rest = rest + fmaR(x.low, h.x, y.low * h.y);
    }
    return fmaR(large_scaled, large, fmaR(small_scaled, small, rest));
}

/// pi / D(h) of GGX: (h.x^2 / au^2 + h.y^2 / av^2 + h.z^2)^2 au av (Walter et al. 2007; Heitz
/// 2014), from au av = r as (s + r h.z^2)^2 / r, which keeps its digits at small alpha (down to
/// 1e-9). In two parts, so that what stands below a line need not be divided twice.
typedef struct {
    Real over, under;
} Quotient;
FN Quotient ggx_d_quotient(vec3 h, Real alpha_u, Real alpha_v) {
    Real r = alpha_u * alpha_v;
    Quotient d;
    d.over = fmaR(r, R(INV_PI_HIGH), r * R(INV_PI_LOW));
    d.under = square(add_roughness_scaled_square(h, alpha_u, alpha_v, r * (h.z * h.z)));
    return d;
}

/// GGX density of normals h, 1/sr.
FN Real ggx_d(vec3 h, Real alpha_u, Real alpha_v) {
    Quotient d = ggx_d_quotient(h, alpha_u, alpha_v);
    return d.over / d.under;
}

/// Smith masking of GGX: 2 / (1 + sqrt(1 + slope^2)).
FN Real ggx_g1(vec3 w, Real alpha_u, Real alpha_v) {
    return 2.f * w.z / (w.z + stretched_length(w, alpha_u, alpha_v));
}

/// G1(wo) D(h) / wo.z of GGX: the density of visible normals is this times wo.h.
FN Real ggx_visible_d(vec3 wo, vec3 h, Real alpha_u, Real alpha_v) {
    Quotient d = ggx_d_quotient(h, alpha_u, alpha_v);
    return 2.f * d.over / (d.under * (wo.z + stretched_length(wo, alpha_u, alpha_v)));
}

/// wo stretched by the roughness into a direction among the normals of a sphere.
FN vec3 stretched_direction(vec3 wo, Real alpha_u, Real alpha_v) {
    return scale3(v3(alpha_u * wo.x, alpha_v * wo.y, wo.z),
                  R(1.) / stretched_length(wo, alpha_u, alpha_v));
}

/// The visible normal of GGX at azimuth phi and height u of the spherical cap that a stretched
/// direction sees.
FN vec3 ggx_visible_normal(vec3 stretched, SinCos phi, Real u, Real alpha_u, Real alpha_v) {
    Real z = (R(1.) - u) * (R(1.) + stretched.z) - stretched.z;
    Real r = sqrt_nonnegative((R(1.) - z) * (R(1.) + z));
    vec3 half_vector = add3(v3(r * phi.cosine, r * phi.sine, z), stretched);
    // z + stretched.z = (1 - u)(1 + stretched.z) > 0: the normal is never below the horizon.
    return normalize3(
        v3(alpha_u * half_vector.x, alpha_v * half_vector.y, (R(1.) - u) * (R(1.) + stretched.z)));
}

/// A visible normal of GGX for the view direction wo, by spherical caps (Dupuy and Benyoub 2023).
/// pdf(h) = G1(wo) D(h) max(0, wo.h) / wo.z
FN vec3 ggx_sample_visible(vec3 wo, Real alpha_u, Real alpha_v, vec2 u) {
    return ggx_visible_normal(stretched_direction(wo, alpha_u, alpha_v), sincos_turns(u.x), u.y,
                              alpha_u, alpha_v);
}
