// A triangle that emits from the side its winding faces and is so small for its place that corners
// in single precision would not tell its size: one corner a, and from there the edges b and c to
// the others; `extra` is 1 / |cross(b, c)|. Chosen uniformly by area.

FN EmitterSample emitter_area_tiny_triangle_sample(Light l, vec3 p, vec2 u) {
    vec2 at = triangle_uniform(u);
    EmitterSample s = emitter_edges_sample(l, p, at);
    // As emitter_corners_error, for corners that are all where a is.
    vec3 to = abs3(sub3(light_a(l), p));
    Real error = max_component(to) * (3.f * GAMMA(16.f));
    // The record's corner and the primitive's are each rounded to single precision, whatever Real
    // is: 2^-24 of their place in x, y and z, so that their planes are no more than 4 of that
    // apart.
    error = error + max_component(abs3(light_a(l))) * R(2.384185791015625e-7);
    s.q_error = add3(s.q_error, splat3(error));
    return s;
}

FN Real emitter_area_tiny_triangle_pdf(Light l, vec3 p, vec3 wi, vec3 q) {
    return emitter_area_pdf(l, p, q, light_edges_normal(l));
}

FN Mask emitter_area_tiny_triangle_faces(Light l, vec3 wi, vec3 q) {
    return dot3(light_edges_normal(l), wi) < R(0.);
}
