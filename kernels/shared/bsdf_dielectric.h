// Smooth dielectric interface: reflects with the probability of the Fresnel reflectance, refracts
// otherwise.

FN BsdfEval bsdf_dielectric_eval(Material m, vec3 wo, vec3 wi) { return bsdf_eval_none(); }

FN BsdfSample bsdf_dielectric_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    Interface i = material_interface(m, wo.z > R(0.));
    Fresnel f = fresnel_dielectric(absR(wo.z), i);
    Mask reflect = u_lobe < f.reflectance;
    s.wi = sel3(reflect, reflect_local(wo), refract_local_with(wo, f.g, i));
    s.weight = sel3(reflect, material_reflectance(m),
                    scale3(material_transmittance(m), i.inv_eta * i.inv_eta));
    s.pdf = LANE_INFINITY;
    s.eta = sel(reflect, R(1.), i.eta);
    return s;
}
