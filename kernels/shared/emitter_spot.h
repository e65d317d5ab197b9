// A spot light: a point at a, axis b (unit); full intensity within the beam, linear in the angle
// down to 0 at the cutoff. cx: cosine of the cutoff, cy: the cutoff angle, cz: 1 / (cutoff - beam),
// extra: cosine of the beam width.

FN Real emitter_spot_falloff(Light l, Real cosine) {
    Real inside = minR(cosine, R(1.));
    Real between = (l.cy - acosR(inside)) * l.cz;
    return sel(cosine <= l.cx, R(0.), sel(cosine >= l.extra, R(1.), between));
}

FN EmitterSample emitter_spot_sample(Light l, vec3 p, vec2 u) {
    EmitterSample s = emitter_point_incident(l, p, light_radiance(l));
    s.weight = scale3(s.weight, emitter_spot_falloff(l, -dot3(s.wi, light_b(l))));
    return s;
}

FN Real emitter_spot_pdf(Light l, vec3 p, vec3 wi, vec3 q) { return R(0.); }
FN Mask emitter_spot_faces(Light l, vec3 wi, vec3 q) { return wi.x != wi.x; }
