// Parallel light from infinity: b the way it travels (unit), rgb the irradiance on a surface facing
// it.

FN EmitterSample emitter_directional_sample(Light l, vec3 p, vec2 u) {
    EmitterSample s = emitter_sample_none();
    s.wi = neg3(light_b(l));
    s.weight = scale3(light_radiance(l), light_inverse_pmf(l));
    s.distant = l.bx == l.bx;
    return s;
}

FN Real emitter_directional_pdf(Light l, vec3 p, vec3 wi, vec3 q) { return R(0.); }
FN Mask emitter_directional_faces(Light l, vec3 wi, vec3 q) { return wi.x != wi.x; }
