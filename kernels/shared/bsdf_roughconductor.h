// Rough conductor: microfacet reflection (Torrance and Sparrow 1967; Walter et al. 2007).

FN BsdfEval bsdf_roughconductor_eval(Material m, vec3 wo, vec3 wi) {
    Mask reflects = (wo.z > R(0.)) & (wi.z > R(0.));
    // Placeholders keep lanes that do not reflect away from divisions by zero; their results are
    // not used.
    vec3 up = v3(R(0.), R(0.), R(1.));
    vec3 o = sel3(reflects, wo, up), i = sel3(reflects, wi, up);
    vec3 h = normalize3(add3(o, i));
    Real cosine = dot3(o, h);
    vec3 fresnel = fresnel_conductor_rgb(cosine, material_eta(m), material_k(m));
    Real value = .25f * microfacet_visible_d(m, o, h) * microfacet_g1(m, i);
    BsdfEval e;
    e.f = sel3(reflects, scale3(mul3(fresnel, material_reflectance(m)), value), splat3(R(0.)));
    e.pdf = sel(reflects, .25f * microfacet_sample_visible_d(m, o, h), R(0.));
    return e;
}

FN BsdfSample bsdf_roughconductor_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    Mask front = wo.z > R(0.);
    vec3 o = sel3(front, wo, v3(R(0.), R(0.), R(1.)));
    NormalSample n = microfacet_sample(m, o, u);
    Real cosine = dot3(o, n.h);
    vec3 wi = reflect_about(o, n.h);
    Mask reflects = front & (wi.z > R(0.));
    wi = sel3(reflects, wi, s.wi);
    vec3 fresnel = fresnel_conductor_rgb(cosine, material_eta(m), material_k(m));
    vec3 weight = scale3(mul3(fresnel, material_reflectance(m)), n.weight * microfacet_g1(m, wi));
    s.wi = wi;
    s.weight = sel3(reflects, weight, s.weight);
    s.pdf = sel(reflects, .25f * n.visible_d, R(0.));
    return s;
}
