// A triangle that emits from the side its winding faces: corners a, b, c; chosen uniformly by area.

FN vec3 emitter_area_triangle_normal(Light l) {
    return normalize3(cross3(sub3(light_b(l), light_a(l)), sub3(light_c(l), light_a(l))));
}

FN EmitterSample emitter_area_triangle_sample(Light l, vec3 p, vec2 u) {
    vec2 b = triangle_uniform(u);
    vec3 a0 = light_a(l), a1 = light_b(l), a2 = light_c(l);
    vec3 error = scale3(interpolate3(abs3(a0), abs3(a1), abs3(a2), b.x, b.y), GAMMA(7.f));
    return emitter_area_finish(l, p, interpolate3(a0, a1, a2, b.x, b.y), error,
                               emitter_area_triangle_normal(l));
}

FN Real emitter_area_triangle_pdf(Light l, vec3 p, vec3 wi, vec3 q) {
    return emitter_area_pdf(l, p, q, emitter_area_triangle_normal(l));
}

/// Does the emitter's bright side face against wi at the point q?
FN Mask emitter_area_triangle_faces(Light l, vec3 wi, vec3 q) {
    return dot3(emitter_area_triangle_normal(l), wi) < R(0.);
}
