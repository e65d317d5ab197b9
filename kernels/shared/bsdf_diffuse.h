// Lambertian reflection: k_d / pi on the upper hemisphere, 0 below.

FN BsdfEval bsdf_diffuse_eval(Material m, vec3 wo, vec3 wi) {
    Mask reflects = (wo.z > R(0.)) & (wi.z > R(0.));
    BsdfEval e;
    e.pdf = sel(reflects, wi.z * R(INV_PI), R(0.));
    e.f = scale3(material_reflectance(m), e.pdf);
    return e;
}

FN BsdfSample bsdf_diffuse_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    Mask reflects = wo.z > R(0.);
    s.wi = hemisphere_cosine(u);
    s.pdf = sel(reflects, s.wi.z * R(INV_PI), R(0.));
    s.weight = sel3(reflects, material_reflectance(m), s.weight);
    return s;
}
