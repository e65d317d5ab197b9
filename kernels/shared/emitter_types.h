// What sampling an emitter returns, and the conventions of all emitters.
//
// emitter_<kind>_sample(light, p, u): light arriving at point p. Densities are in solid angle at p
// and include the probability (light.pmf) with which this row of the light table was picked.
// emitter_<kind>_pdf(light, p, wi, q): the density with which sample would have chosen wi, for the
// point q it hits.

typedef struct {
    vec3 wi;     // unit direction to the emitter
    vec3 weight; // radiance / pdf; for delta emitters incident irradiance on a facing surface /
                 // pmf; 0: nothing arrives
    Real inverse_pdf; // sr; 0 for delta emitters, and where nothing arrives
    vec3 q;           // the point on the emitter
    vec3 q_error;     // rounding error bound of q
    vec3 q_normal;    // unit normal there; any non-zero vector for a point without surface
    Mask distant;     // there is no such point: the light comes from infinity
} EmitterSample;

FN EmitterSample emitter_sample_none(void) {
    EmitterSample s;
    s.wi = v3(R(0.), R(0.), R(1.));
    s.weight = splat3(R(0.));
    s.inverse_pdf = R(0.);
    s.q = splat3(R(0.));
    s.q_error = splat3(R(0.));
    s.q_normal = v3(R(0.), R(0.), R(1.));
    s.distant = s.inverse_pdf != s.inverse_pdf;
    return s;
}

FN vec3 light_a(Light l) { return v3(l.ax, l.ay, l.az); }
FN vec3 light_b(Light l) { return v3(l.bx, l.by, l.bz); }
FN vec3 light_c(Light l) { return v3(l.cx, l.cy, l.cz); }
/// Of an emitter with the corners a, b, c, and 1 / |cross(b - a, c - a)| in `extra`: the side that
/// emits.
FN vec3 light_corners_normal(Light l) {
    return scale3(cross3(sub3(light_b(l), light_a(l)), sub3(light_c(l), light_a(l))), l.extra);
}
/// The same of an emitter with the edges b and c, and +-1 / |cross(b, c)|.
FN vec3 light_edges_normal(Light l) { return scale3(cross3(light_b(l), light_c(l)), l.extra); }
FN vec3 light_radiance(Light l) { return v3(l.r, l.g, l.b); }
/// 1 / l.pmf: a light that has no other beside it is always picked.
FN Real light_inverse_pmf(Light l) {
    if (!HAS(light_tree)) return R(1.);
    return R(1.) / l.pmf;
}

/// The error bound of a point q in the plane of the corners a, b, c, enlarged by that of where a
/// ray from p meets it: the walk computes that from the corners as it sees them, which may be many
/// times as far from p as q is. A shadow ray that ends outside of it is not blocked by its own
/// light. (16 u is measured: without it 1e-5 of the rays to a light 100 times as wide as it is far
/// are lost.)
FN vec3 emitter_corners_error(Light l, vec3 p, vec3 q_error) {
    vec3 a = abs3(sub3(light_a(l), p)), b = abs3(sub3(light_b(l), p)),
         c = abs3(sub3(light_c(l), p));
    return add3(q_error, splat3(max_component(add3(a, add3(b, c))) * GAMMA(16.f)));
}

/// Finishes a sample chosen uniformly by area: q and its normal given. One-sided.
FN EmitterSample emitter_area_finish(Light l, vec3 p, vec3 q, vec3 q_error, vec3 q_normal) {
    vec3 to = sub3(q, p);
    Real distance_squared = dot3(to, to);
    Mask apart = distance_squared > R(0.);
    Real inverse = R(1.) / sqrtR(sel(apart, distance_squared, R(1.)));
    EmitterSample s;
    s.wi = scale3(to, inverse);
    Real cosine = -dot3(s.wi, q_normal);
    Mask lit = apart & (cosine > R(0.));
    Real jacobian = cosine * inverse * inverse;
    s.inverse_pdf = sel(lit, jacobian * (l.area * light_inverse_pmf(l)), R(0.));
    s.weight = scale3(light_radiance(l), s.inverse_pdf);
    s.q = q;
    s.q_error = q_error;
    s.q_normal = q_normal;
    s.distant = inverse != inverse;
    return s;
}

/// A sample of an emitter in the plane of the edges b and c, at `at` times them from a, chosen
/// uniformly by area.
FN EmitterSample emitter_edges_sample(Light l, vec3 p, vec2 at) {
    vec3 q = add3(light_a(l), add3(scale3(light_b(l), at.x), scale3(light_c(l), at.y)));
    vec3 error = add3(abs3(light_a(l)), add3(scale3(abs3(light_b(l)), absR(at.x)),
                                             scale3(abs3(light_c(l)), absR(at.y))));
    return emitter_area_finish(l, p, q, scale3(error, GAMMA(7.f)), light_edges_normal(l));
}

/// Turns a sample of a shape that was chosen uniformly by solid angle (sr), where it was, into one
/// with that density.
FN EmitterSample emitter_solid_angle_finish(Light l, EmitterSample s, Mask chosen,
                                            Real solid_angle) {
    Mask lit = chosen & (s.inverse_pdf > R(0.));
    s.inverse_pdf = sel(lit, solid_angle * light_inverse_pmf(l), s.inverse_pdf);
    s.weight = scale3(light_radiance(l), s.inverse_pdf);
    return s;
}

/// Density in solid angle of a shape seen under `solid_angle`: uniform in it, or by area if small.
FN Real emitter_solid_angle_pdf(Light l, Real solid_angle, Real by_area) {
    Mask wide = solid_angle >= R(SOLID_ANGLE_LEAST);
    return sel(wide, l.pmf / sel(wide, solid_angle, R(1.)), by_area);
}

/// Density in solid angle of choosing the point q by area, seen from p.
FN Real emitter_area_pdf(Light l, vec3 p, vec3 q, vec3 q_normal) {
    vec3 to = sub3(q, p);
    Real distance_squared = dot3(to, to);
    Real cosine_distance = absR(dot3(to, q_normal)); // cosine * distance
    Mask seen = cosine_distance > R(0.);
    return sel(seen,
               l.pmf * distance_squared * sqrtR(distance_squared) /
                   sel(seen, l.area * cosine_distance, R(1.)),
               LANE_INFINITY);
}
