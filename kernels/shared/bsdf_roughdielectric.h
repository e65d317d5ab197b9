// Rough dielectric interface: microfacet reflection and refraction (Walter et al. 2007, "Microfacet
// models for refraction through rough surfaces").

FN BsdfEval bsdf_roughdielectric_eval(Material m, vec3 wo, vec3 wi) {
    Mask outside = wo.z > R(0.);
    Interface face = material_interface(m, outside);
    Real side = copysignR(R(1.), wo.z);
    Mask usable = (wo.z != R(0.)) & (wi.z != R(0.));
    vec3 up = v3(R(0.), R(0.), R(1.));
    vec3 o = sel3(usable, scale3(wo, side), up),
         i = sel3(usable, scale3(wi, side), up); // o is on the upper side
    Mask reflect = i.z > R(0.);
    vec3 half_vector = add3(o, scale3(i, sel(reflect, R(1.), face.eta)));
    // eta = 1 transmits straight on only: the half vector vanishes and no rough transmission is
    // left to evaluate.
    Real length_squared = dot3(half_vector, half_vector);
    usable = usable & (length_squared > R(0.));
    vec3 h =
        sel3(usable, scale3(half_vector, R(1.) / sqrtR(sel(usable, length_squared, R(1.)))), up);
    h = scale3(h, copysignR(R(1.), h.z));
    Real oh = dot3(o, h), ih = dot3(i, h);
    usable = usable & (oh > R(0.)) & (sel(reflect, ih, -ih) > R(0.)) & (h.z > R(0.));
    oh = sel(usable, oh, R(1.));
    ih = sel(usable, ih, sel(reflect, R(1.), R(-1.)));
    Fresnel f = fresnel_dielectric(oh, face);
    vec3 i_up = v3(i.x, i.y, absR(i.z));
    Real dg = microfacet_visible_d(m, o, h) * microfacet_g1(m, i_up);
    Real jacobian = half_vector_jacobian(reflect, oh, ih, face.eta);
    Real share = sel(reflect, f.reflectance, f.transmittance);
    Real scale = sel(reflect, R(1.), square(face.inv_eta));
    Real value = share * dg * jacobian * scale;
    BsdfEval e;
    e.f = sel3(usable,
               scale3(sel3(reflect, material_reflectance(m), material_transmittance(m)), value),
               splat3(R(0.)));
    e.pdf = sel(usable, share * microfacet_sample_visible_d(m, o, h) * jacobian, R(0.));
    return e;
}

FN BsdfSample bsdf_roughdielectric_sample(Material m, vec3 wo, vec2 u, Real u_lobe) {
    BsdfSample s = bsdf_sample_none();
    Mask outside = wo.z > R(0.);
    Interface face = material_interface(m, outside);
    Real side = copysignR(R(1.), wo.z);
    Mask usable = wo.z != R(0.);
    vec3 o = sel3(usable, scale3(wo, side), v3(R(0.), R(0.), R(1.)));
    NormalSample n = microfacet_sample(m, o, u);
    Real oh = dot3(o, n.h);
    usable = usable & (oh > R(0.));
    oh = sel(usable, oh, R(1.));
    Fresnel f = fresnel_dielectric(oh, face);
    Mask reflect = u_lobe < f.reflectance;
    vec3 wi = sel3(reflect, reflect_about(o, n.h), refract_about(o, n.h, oh, f.g, face));
    usable = usable & (sel(reflect, wi.z, -wi.z) > R(0.));
    vec3 i_up = sel3(usable, v3(wi.x, wi.y, absR(wi.z)), v3(R(0.), R(0.), R(1.)));
    Real ih = sel(usable, dot3(wi, n.h), sel(reflect, R(1.), R(-1.)));
    Real jacobian = half_vector_jacobian(reflect, oh, ih, face.eta);
    Real weight = n.weight * microfacet_g1(m, i_up) * sel(reflect, R(1.), square(face.inv_eta));
    s.wi = sel3(usable, scale3(wi, side), s.wi);
    s.weight = sel3(
        usable, scale3(sel3(reflect, material_reflectance(m), material_transmittance(m)), weight),
        s.weight);
    s.pdf =
        sel(usable, n.visible_d * jacobian * sel(reflect, f.reflectance, f.transmittance), R(0.));
    s.eta = sel(usable & !reflect, face.eta, R(1.));
    return s;
}
