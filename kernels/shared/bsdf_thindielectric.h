// A dielectric slab too thin to displace the ray, the reflections inside it summed: R' = 2R/(1+R),
// T' = T/(1+R).

FN BsdfEval bsdf_thindielectric_eval(Material m, vec3 wo, vec3 wi) { return bsdf_eval_none(); }

FN BsdfSample bsdf_thindielectric_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    Fresnel f = fresnel_dielectric(absR(wo.z), material_interface(m, wo.z == wo.z));
    Mask reflect = u_lobe < 2.f * f.reflectance / (R(1.) + f.reflectance);
    s.wi = sel3(reflect, reflect_local(wo), neg3(wo));
    s.weight = sel3(reflect, material_reflectance(m), material_transmittance(m));
    s.pdf = LANE_INFINITY;
    return s;
}
