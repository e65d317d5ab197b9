// Beckmann, anisotropic (Walter et al. 2007; Heitz and d'Eon 2014): density of normals,
// shadowing-masking, and sampling of visible normals.
//
// Directions are local (normal +z), on the upper side. Stretched by the roughness, slopes of
// normals are spread as exp(-x^2 - y^2) / pi; seen from a direction of the cosine c and the sine s,
// slopes x towards it as (c - s x) exp(-x^2) up to where they are seen edge on, a = c / s.

/// Beckmann density of normals h, 1/sr.
FN Real beckmann_d(vec3 h, Real alpha_u, Real alpha_v) {
    Real z_squared = h.z * h.z, scale = alpha_u * alpha_v * z_squared;
    Real e = exp_negative(-add_roughness_scaled_square(h, alpha_u, alpha_v, R(0.)) / scale);
    return e * R(INV_PI) / (scale * z_squared);
}

/// Across the normal, of a direction stretched by the roughness: over w.z its slope.
FN Real stretched_across(vec3 w, Real alpha_u, Real alpha_v) {
    return sqrtR(square(alpha_u * w.x) + square(alpha_v * w.y));
}

/// Smith masking of Beckmann, the rational approximation of Walter et al. 2007 (0.35 % from the
/// exact form) in a = 1 / slope.
FN Real beckmann_g1(vec3 w, Real alpha_u, Real alpha_v) {
    Real across = stretched_across(w, alpha_u, alpha_v);
    Mask sloped = across > R(0.);
    Real a = w.z / sel(sloped, across, R(1.));
    Real g = a * (R(3.535) + R(2.181) * a) / (R(1.) + a * (R(2.276) + R(2.577) * a));
    return sel((a >= R(1.6)) | !sloped, R(1.), g);
}

/// Stretched by the roughness: what a direction sees of the slopes.
typedef struct {
    Real length;        // of the direction once stretched
    Real cosine, sine;  // of its angle to the normal then
    Real edge, at_edge; // the slope seen edge on, a, and exp(-a^2)
    Real whole;         // c erfc(-a) + s exp(-a^2) / sqrt(pi): 2 c / G1
} SeenSlopes;

FN SeenSlopes beckmann_seen_slopes(vec3 wo, Real alpha_u, Real alpha_v) {
    SeenSlopes v;
    v.length = stretched_length(wo, alpha_u, alpha_v);
    v.cosine = wo.z / v.length;
    v.sine = stretched_across(wo, alpha_u, alpha_v) / v.length;
    v.edge = v.cosine / v.sine;
    v.at_edge = exp_negative(-square(v.edge));
    Real beyond = v.at_edge * scaled_erfc(v.edge);
    v.whole = v.cosine * (R(2.) - beyond) + v.sine * v.at_edge * R(INV_SQRT_PI);
    return v;
}

/// Close enough to the slope below which there is the share t of those seen for beckmann_seen_slope
/// to find it: between the Gaussian of a view along the normal and the Rayleigh distribution of a
/// grazing one; towards the edge, where the density falls to nothing, by a parabola.
FN Real beckmann_slope_guess(SeenSlopes v, Real t) {
    Real along = gaussian_quantile(t), grazing = -sqrt_nonnegative(-log_unit(t));
    Real w = R(1.) / (R(1.) + v.edge * (R(.7) + R(.3) * v.edge));
    Real from_edge = sqrtR(v.sine * v.at_edge / ((R(1.) - t) * v.whole * R(SQRT_PI)));
    return minR(along + w * (grazing - along), v.edge - R(1.) / (from_edge + R(1.2)));
}

/// A step of Halley's method towards the slope below which there is the share t of those seen; at
/// most two of Newton's, for next to the edge what is off is mostly rounding.
FN Real beckmann_slope_step(SeenSlopes v, Real t, Real x) {
    Real e = exp_negative(-square(x)), tail = e * scaled_erfc(absR(x));
    Real below = v.cosine * sel(x < R(0.), tail, R(2.) - tail) + v.sine * e * R(INV_SQRT_PI);
    Real off = below - t * v.whole, seen = v.cosine - v.sine * x;
    Real newton = R(2. * INV_SQRT_PI) * e * square(seen);
    Real under = maxR(newton + .5f * off * (v.sine + R(2.) * x * seen), .5f * newton);
    Real next = x - off * seen / sel(under > R(0.), under, R(1.));
    return minR(sel(under > R(0.), next, x), v.edge);
}

/// The slope towards the viewer below which there is the share t of those seen, t in (0, 1). From
/// the guess two steps leave the share within 1e-9 of t, but for rounding, whatever the view.
FN Real beckmann_seen_slope(SeenSlopes v, Real t) {
    return beckmann_slope_step(v, t, beckmann_slope_step(v, t, beckmann_slope_guess(v, t)));
}

/// 1 - u for u in [0, 1), its ends left out.
FN Real inside_unit(Real u) { return (R(1.) - u) * R(.99999994039535522461); }

/// A visible normal of Beckmann for the view direction wo, by slopes as in Heitz and d'Eon 2014,
/// "Importance sampling microfacet-based BSDFs using the distribution of visible normals".
/// pdf(h) = beckmann_sample_visible_d(wo, h) max(0, wo.h)
FN vec3 beckmann_sample_visible(vec3 wo, Real alpha_u, Real alpha_v, vec2 u) {
    SeenSlopes v = beckmann_seen_slopes(wo, alpha_u, alpha_v);
    Real towards = beckmann_seen_slope(v, inside_unit(u.x));
    Real across = gaussian_quantile(inside_unit(u.y));
    Mask sloped = v.sine > R(0.);
    Real scale = R(1.) / sel(sloped, v.length * v.sine, R(1.));
    Real cosine = sel(sloped, alpha_u * wo.x * scale, R(1.)), sine = alpha_v * wo.y * scale;
    return normalize3(v3(-alpha_u * (towards * cosine - across * sine),
                         -alpha_v * (towards * sine + across * cosine), R(1.)));
}

/// Beckmann's exact G1(wo) D(h) / wo.z: over wo.h the density of visible normals.
FN Real beckmann_sample_visible_d(vec3 wo, vec3 h, Real alpha_u, Real alpha_v) {
    SeenSlopes v = beckmann_seen_slopes(wo, alpha_u, alpha_v);
    return R(2.) * beckmann_d(h, alpha_u, alpha_v) / (v.length * v.whole);
}

/// The masking that a lobe has over that of its visible normals.
FN Real beckmann_masking_ratio(vec3 wo, Real alpha_u, Real alpha_v) {
    SeenSlopes v = beckmann_seen_slopes(wo, alpha_u, alpha_v);
    return .5f * beckmann_g1(wo, alpha_u, alpha_v) * v.whole / v.cosine;
}
