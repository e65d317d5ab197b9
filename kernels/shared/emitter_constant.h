// A sky of the same radiance in every direction.

FN EmitterSample emitter_constant_sample(Light l, vec3 p, vec2 u) {
    EmitterSample s = emitter_sample_none();
    s.wi = sphere_uniform(u);
    s.inverse_pdf = R(4. * PI) * light_inverse_pmf(l);
    s.weight = scale3(light_radiance(l), s.inverse_pdf);
    s.distant = s.inverse_pdf == s.inverse_pdf;
    return s;
}

FN Real emitter_constant_pdf(Light l, vec3 p, vec3 wi, vec3 q) { return l.pmf * R(INV_FOUR_PI); }
FN Mask emitter_constant_faces(Light l, vec3 wi, vec3 q) { return wi.x == wi.x; }
