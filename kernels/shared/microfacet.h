// Microfacet distributions of materials: density, shadowing-masking, and sampling of visible
// normals.
//
// Directions are local (normal +z), on the upper side. Shadowing-masking is the separable Smith
// form G1(wi) G1(wo), as in Mitsuba 3, so that images agree.

/// Asked only where HAS(beckmann). (A mask of lanes must not be combined with a plain int: 1 is no
/// mask.)
FN Mask is_beckmann(Material m) { return (m.distribution & 1) != 0; }

/// G1(wo) D(h) / wo.z of the material's distribution.
FN Real microfacet_visible_d(Material m, vec3 wo, vec3 h) {
    Real d = R(0.);
    if (HAS(ggx)) d = ggx_visible_d(wo, h, m.alpha_u, m.alpha_v);
    if (HAS(beckmann)) {
        if (someLane(is_beckmann(m))) {
            Real masking = beckmann_g1(wo, m.alpha_u, m.alpha_v);
            d = sel(is_beckmann(m), masking * beckmann_d(h, m.alpha_u, m.alpha_v) / wo.z, d);
        }
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
    Real visible_d; // density of h (1/sr) over wo.h
    Real weight; // G1(wo) D(h) (wo.h) / (wo.z pdf(h)): 1 but for the approximation of Beckmann's G1
} NormalSample;

/// Over wo.h, the density with which microfacet_sample returns h.
FN Real microfacet_sample_visible_d(Material m, vec3 wo, vec3 h) {
    Real d = R(0.);
    if (HAS(ggx)) d = ggx_visible_d(wo, h, m.alpha_u, m.alpha_v);
    if (HAS(beckmann)) {
        if (someLane(is_beckmann(m)))
            d = sel(is_beckmann(m), beckmann_sample_visible_d(wo, h, m.alpha_u, m.alpha_v), d);
    }
    return d;
}

/// A normal as they are seen from wo.
FN NormalSample microfacet_sample(Material m, vec3 wo, vec2 u) {
    NormalSample s;
    s.h = v3(R(0.), R(0.), R(1.));
    s.weight = R(1.);
    if (HAS(ggx)) s.h = ggx_sample_visible(wo, m.alpha_u, m.alpha_v, u);
    if (HAS(beckmann)) {
        if (someLane(is_beckmann(m))) {
            vec3 h = beckmann_sample_visible(wo, m.alpha_u, m.alpha_v, u);
            s.h = sel3(is_beckmann(m), h, s.h);
            s.weight = sel(is_beckmann(m), beckmann_masking_ratio(wo, m.alpha_u, m.alpha_v), R(1.));
        }
    }
    s.visible_d = microfacet_sample_visible_d(m, wo, s.h);
    return s;
}

/// oh dh/dwi, the Jacobian of the half vector of reflection or refraction (Walter et al. 2007, eqs.
/// 14, 17), for cosines to h on this side (oh > 0) and of wi (beyond: ih < 0).
FN Real half_vector_jacobian(Mask reflect, Real oh, Real ih, Real eta) {
    Real refracted = oh * square(eta) * absR(ih) / square(sel(reflect, R(1.), oh + eta * ih));
    return sel(reflect, R(.25), refracted);
}
