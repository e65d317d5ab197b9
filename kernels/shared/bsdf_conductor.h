// Smooth conductor: mirror reflection weighted by the conductor Fresnel term.

FN BsdfEval bsdf_conductor_eval(Material m, vec3 wo, vec3 wi) { return bsdf_eval_none(); }

FN BsdfSample bsdf_conductor_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    Mask reflects = wo.z > R(0.);
    vec3 f = fresnel_conductor_rgb(maxR(wo.z, R(0.)), material_eta(m), material_k(m));
    s.wi = reflect_local(wo);
    s.weight = sel3(reflects, mul3(f, material_reflectance(m)), s.weight);
    s.pdf = sel(reflects, LANE_INFINITY, R(0.));
    return s;
}
