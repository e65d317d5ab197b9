// A triangle that emits from the side its winding faces and is so small for its place that corners
// in single precision would not tell its size: one corner a, and from there the edges b and c to
// the others; `extra` is 1 / |cross(b, c)|. Chosen uniformly by area.

FN EmitterSample emitter_area_tiny_triangle_sample(Light l, vec3 p, vec2 u) {
    vec2 at = triangle_uniform(u);
    EmitterSample s = emitter_edges_sample(l, p, at);
    // As emitter_corners_error, for corners that are all where a is.
    vec3 to = abs3(sub3(light_a(l), p));
    s.q_error = add3(s.q_error, splat3(max_component(to) * (3.f * GAMMA(16.f))));
    return s;
}

FN Real emitter_area_tiny_triangle_pdf(Light l, vec3 p, vec3 wi, vec3 q) {
    return emitter_area_pdf(l, p, q, light_edges_normal(l));
}

FN Mask emitter_area_tiny_triangle_faces(Light l, vec3 wi, vec3 q) {
    return dot3(light_edges_normal(l), wi) < R(0.);
}
