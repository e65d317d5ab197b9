// A matte base under a rough dielectric coat, as in Mitsuba 3: microfacets reflect, and what they
// let in and out again is spread by the base, all orders of reflection between the two summed.
//
// What the coat lets through depends on the direction by an integral, which a table holds: here it
// is given, towards the viewer and from the light (types.h: kb, eg).

/// f cos(wi) of the base.
FN vec3 bsdf_roughplastic_base(Material m, vec3 wi) {
    return scale3(coated_reflectance(m, R(1.) / m.er), m.kb * m.eg * (wi.z * R(INV_PI)));
}

/// For directions above the surface, and the normal that mirrors one to the other.
FN BsdfEval coated_eval(Material m, CoatChances chances, vec3 wo, vec3 wi, vec3 h) {
    Fresnel f = fresnel_dielectric(dot3(wo, h), material_interface(m, wo.z == wo.z));
    Real mirrored = .25f * f.reflectance * microfacet_visible_d(m, wo, h) * microfacet_g1(m, wi);
    BsdfEval e;
    e.f = add3(scale3(material_transmittance(m), mirrored), bsdf_roughplastic_base(m, wi));
    e.pdf = chances.mirrors * (.25f * microfacet_sample_visible_d(m, wo, h)) +
            chances.spreads * (wi.z * R(INV_PI));
    return e;
}

FN BsdfEval bsdf_roughplastic_eval(Material m, vec3 wo, vec3 wi) {
    Mask reflects = (wo.z > R(0.)) & (wi.z > R(0.));
    vec3 up = v3(R(0.), R(0.), R(1.));
    vec3 o = sel3(reflects, wo, up), i = sel3(reflects, wi, up);
    CoatChances chances = coat_chances(m, R(1.) - m.kb, m.kb);
    BsdfEval e = coated_eval(m, chances, o, i, normalize3(add3(o, i)));
    e.f = sel3(reflects, e.f, splat3(R(0.)));
    e.pdf = sel(reflects, e.pdf, R(0.));
    return e;
}

FN BsdfSample bsdf_roughplastic_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    Mask front = wo.z > R(0.);
    vec3 up = v3(R(0.), R(0.), R(1.));
    vec3 o = sel3(front, wo, up);
    CoatChances chances = coat_chances(m, R(1.) - m.kb, m.kb);
    Mask mirrors = u_lobe < chances.mirrors;
    vec3 h = microfacet_sample(m, o, u).h;
    vec3 wi = sel3(mirrors, reflect_about(o, h), hemisphere_cosine(u));
    Mask scatters = front & (wi.z > R(0.));
    wi = sel3(scatters, wi, up);
    // Of a narrow lobe only the normal that was drawn tells where in it a direction lies.
    h = sel3(scatters & mirrors, h, normalize3(add3(o, wi)));
    BsdfEval e = coated_eval(m, chances, o, wi, h);
    scatters = scatters & (e.pdf > R(0.));
    s.wi = sel3(scatters, wi, s.wi);
    s.weight = sel3(scatters, scale3(e.f, R(1.) / sel(scatters, e.pdf, R(1.))), s.weight);
    s.pdf = sel(scatters, e.pdf, R(0.));
    return s;
}
