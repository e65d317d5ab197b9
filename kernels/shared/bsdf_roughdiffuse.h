// Rough matte surface: V-shaped grooves of Lambertian facets that shadow and mask each other, by
// the qualitative model of Oren and Nayar 1994, "Generalization of Lambert's reflectance model".
// It conserves energy but for light that grazes the surface, of which up to 1.0152 times the
// reflectance is sent on (at alpha 0.28); their fuller approximation, up to 1.04 times.

/// f over the reflectance, times pi and `scale`, for directions above the surface. With alpha the
/// larger of their angles to the normal and beta the smaller, cos(phi) sin(alpha) tan(beta) is what
/// they have in common along the surface over the larger of their cosines.
FN Real groove_share(Material m, vec3 wo, vec3 wi, Real scale) {
    // As in Mitsuba 0.6, alpha is the root mean square slope: twice the variance of its angle.
    Real variance = .5f * m.alpha_u * m.alpha_u;
    Real a = R(1.) - .5f * variance / (variance + R(.33));
    Real b = R(.45) * variance / (variance + R(.09));
    Real along = maxR(wo.x * wi.x + wo.y * wi.y, R(0.));
    return a * scale + b * along * (scale / maxR(wo.z, wi.z));
}

FN BsdfEval bsdf_roughdiffuse_eval(Material m, vec3 wo, vec3 wi) {
    BsdfEval e = bsdf_diffuse_eval(m, wo, wi);
    // A placeholder keeps lanes that do not reflect away from a division by zero.
    vec3 o = sel3(e.pdf > R(0.), wo, v3(R(0.), R(0.), R(1.)));
    e.f = scale3(material_reflectance(m), groove_share(m, o, wi, e.pdf));
    return e;
}

FN BsdfSample bsdf_roughdiffuse_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_diffuse_sample(m, wo, u, u_lobe);
    vec3 o = sel3(s.pdf > R(0.), wo, v3(R(0.), R(0.), R(1.)));
    s.weight = scale3(s.weight, groove_share(m, o, s.wi, R(1.)));
    return s;
}
