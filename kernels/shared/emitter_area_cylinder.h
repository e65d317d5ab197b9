// A cylinder without caps that emits outward (`extra` +1) or inward (-1): base a, axis b, radius
// cx; chosen uniformly by area.

/// Unit, away from the axis, of a point of the cylinder.
FN vec3 emitter_area_cylinder_outward(Light l, vec3 q) {
    vec3 unit = normalize3(light_b(l));
    return normalize3(cross3(unit, cross3(sub3(q, light_a(l)), unit)));
}

FN EmitterSample emitter_area_cylinder_sample(Light l, vec3 p, vec2 u) {
    vec3 axis = light_b(l);
    SinCos phi = sincos_turns(u.y);
    vec3 outward = to_world(frame_from_normal(normalize3(axis)), v3(phi.cosine, phi.sine, R(0.)));
    vec3 q = add3(light_a(l), add3(scale3(axis, u.x), scale3(outward, l.cx)));
    vec3 error = add3(abs3(light_a(l)), add3(scale3(abs3(axis), u.x), scale3(abs3(outward), l.cx)));
    return emitter_area_finish(l, p, q, scale3(error, GAMMA(7.f)), scale3(outward, l.extra));
}

FN Real emitter_area_cylinder_pdf(Light l, vec3 p, vec3 wi, vec3 q) {
    return emitter_area_pdf(l, p, q, emitter_area_cylinder_outward(l, q));
}

FN Mask emitter_area_cylinder_faces(Light l, vec3 wi, vec3 q) {
    return dot3(emitter_area_cylinder_outward(l, q), wi) * l.extra < R(0.);
}
