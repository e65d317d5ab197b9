// A point at a that radiates the intensity rgb (W/sr) in every direction.

/// Incident light of intensity I from the point q: I / distance^2.
FN EmitterSample emitter_point_incident(Light l, vec3 p, vec3 intensity) {
    EmitterSample s = emitter_sample_none();
    vec3 to = sub3(light_a(l), p);
    Real distance_squared = dot3(to, to);
    Mask apart = distance_squared > R(0.);
    Real inverse = R(1.) / sqrtR(sel(apart, distance_squared, R(1.)));
    s.wi = sel3(apart, scale3(to, inverse), s.wi);
    s.weight = sel3(apart, scale3(intensity, inverse * inverse * light_inverse_pmf(l)), s.weight);
    s.q = light_a(l);
    return s;
}

FN EmitterSample emitter_point_sample(Light l, vec3 p, vec2 u) {
    return emitter_point_incident(l, p, light_radiance(l));
}

FN Real emitter_point_pdf(Light l, vec3 p, vec3 wi, vec3 q) { return R(0.); }
FN Mask emitter_point_faces(Light l, vec3 wi, vec3 q) { return wi.x != wi.x; }
