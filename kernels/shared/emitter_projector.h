// A projector: a point at a, axis b (unit), and across that a frame, which its light passes
// through. c: along the upper edge, 1 over the length of that at unit distance; extra: the frame's
// width over its height, less than 0 where the picture is mirrored. It lights a wall across its
// axis evenly: rgb is the intensity (W/sr) on the axis, of other directions more by the cosine to
// the power of -3.

/// Where light that leaves a point along w (unit) meets the frame: (0, 0) is its upper left corner,
/// (1, 1) its lower right one. Only before it, where dot3(w, axis) > 0.
FN vec2 frame_place(vec3 axis, vec3 across, Real aspect, vec3 w) {
    Real ahead = dot3(w, axis);
    Real inverse = R(1.) / sel(ahead > R(0.), ahead, R(1.));
    Real down = dot3(cross3(axis, across), w) * aspect;
    return v2(R(.5) + dot3(across, w) * inverse, R(.5) + down * inverse);
}

FN EmitterSample emitter_projector_sample(Light l, vec3 p, vec2 u) {
    EmitterSample s = emitter_point_incident(l, p, light_radiance(l));
    vec3 w = neg3(s.wi);
    vec2 uv = frame_place(light_b(l), light_c(l), l.extra, w);
    Real ahead = dot3(w, light_b(l));
    Mask inside =
        (ahead > R(0.)) & (uv.x >= R(0.)) & (uv.x <= R(1.)) & (uv.y >= R(0.)) & (uv.y <= R(1.));
    Real inverse = R(1.) / sel(inside, ahead, R(1.));
    s.weight = sel3(inside, scale3(s.weight, inverse * inverse * inverse), splat3(R(0.)));
    return s;
}

FN Real emitter_projector_pdf(Light l, vec3 p, vec3 wi, vec3 q) { return R(0.); }
FN Mask emitter_projector_faces(Light l, vec3 wi, vec3 q) { return wi.x != wi.x; }
