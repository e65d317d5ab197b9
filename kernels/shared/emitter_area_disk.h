// A disk that emits from one side: centre a, edges b and c, `extra` +-1 / |cross(b, c)| with the
// sign of the side; chosen uniformly by area.

FN vec3 emitter_area_disk_normal(Light l) {
    return scale3(cross3(light_b(l), light_c(l)), l.extra);
}

FN EmitterSample emitter_area_disk_sample(Light l, vec3 p, vec2 u) {
    vec2 d = disk_uniform(u);
    vec3 q = add3(light_a(l), add3(scale3(light_b(l), d.x), scale3(light_c(l), d.y)));
    vec3 error = add3(abs3(light_a(l)), add3(scale3(abs3(light_b(l)), absR(d.x)),
                                             scale3(abs3(light_c(l)), absR(d.y))));
    return emitter_area_finish(l, p, q, scale3(error, GAMMA(7.f)), emitter_area_disk_normal(l));
}

FN Real emitter_area_disk_pdf(Light l, vec3 p, vec3 wi, vec3 q) {
    return emitter_area_pdf(l, p, q, emitter_area_disk_normal(l));
}

FN Mask emitter_area_disk_faces(Light l, vec3 wi, vec3 q) {
    return dot3(emitter_area_disk_normal(l), wi) < R(0.);
}
