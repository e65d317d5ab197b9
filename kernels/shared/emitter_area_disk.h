// A disk that emits from one side: centre a, edges b and c, `extra` +-1 / |cross(b, c)| with the
// sign of the side; chosen uniformly by area.

FN EmitterSample emitter_area_disk_sample(Light l, vec3 p, vec2 u) {
    return emitter_edges_sample(l, p, disk_uniform(u));
}

FN Real emitter_area_disk_pdf(Light l, vec3 p, vec3 wi, vec3 q) {
    return emitter_area_pdf(l, p, q, light_edges_normal(l));
}

FN Mask emitter_area_disk_faces(Light l, vec3 wi, vec3 q) {
    return dot3(light_edges_normal(l), wi) < R(0.);
}
