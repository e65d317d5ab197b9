// A parallelogram that emits from the side cross(b - a, c - a) points to: corners a, b, c, and
// b + c - a across from a; `extra` is 1 / |cross(b - a, c - a)|. Chosen uniformly by solid angle,
// or by area where it is seen too small for that (solid_angle.h).

/// Two halves on either side of the diagonal from a. The first random number runs through the
/// first half and on through the second, so that what is evenly spread stays so.
typedef struct {
    SphericalTriangle first, second;
    Real solid_angle;
} SphericalParallelogram;

/// As seen from p; of solid angle 0 where that is not asked for, and from behind.
FN SphericalParallelogram emitter_area_parallelogram_seen(Light l, vec3 p) {
    vec3 a = sub3(light_a(l), p), b = sub3(light_b(l), p), c = sub3(light_c(l), p);
    vec3 e2 = sub3(light_c(l), light_a(l));
    vec3 n = cross3(sub3(light_b(l), light_a(l)), e2);
    Mask near = near_for_solid_angle(scale3(add3(b, c), R(.5)), dot3(n, n)) & (dot3(a, n) < R(0.));
    SphericalParallelogram seen;
    seen.first = seen.second = spherical_triangle_none();
    seen.solid_angle = R(0.);
    if (someLane(near)) {
        vec3 across = add3(b, e2);
        seen.first = spherical_triangle(b, a, across, near);
        seen.second = spherical_triangle(across, a, c, near);
        seen.solid_angle = seen.first.solid_angle + seen.second.solid_angle;
    }
    return seen;
}

FN vec3 spherical_parallelogram_uniform(SphericalParallelogram s, vec2 u) {
    Real at = u.x * s.solid_angle;
    Mask first = at < s.first.solid_angle;
    SphericalTriangle t = sel_spherical_triangle(first, s.first, s.second);
    Real within = sel(first, at, at - s.first.solid_angle);
    Mask there = t.solid_angle > R(0.);
    return spherical_triangle_uniform(t, v2(within / sel(there, t.solid_angle, R(1.)), u.y));
}

FN EmitterSample emitter_area_parallelogram_sample(Light l, vec3 p, vec2 u) {
    vec3 a = light_a(l);
    vec3 e1 = sub3(light_b(l), a), e2 = sub3(light_c(l), a);
    SphericalParallelogram seen = emitter_area_parallelogram_seen(l, p);
    Mask wide = seen.solid_angle >= R(SOLID_ANGLE_LEAST);
    vec2 b = u;
    if (someLane(wide)) {
        vec2 at = plane_coordinates(sub3(a, p), e1, e2, spherical_parallelogram_uniform(seen, u));
        // Rounding may put the point outside, which is no place to emit from.
        b.x = sel(wide, minR(maxR(at.x, R(0.)), R(1.)), b.x);
        b.y = sel(wide, minR(maxR(at.y, R(0.)), R(1.)), b.y);
    }
    vec3 q = add3(a, add3(scale3(e1, b.x), scale3(e2, b.y)));
    vec3 size = add3(abs3(a), add3(scale3(add3(abs3(light_b(l)), abs3(a)), b.x),
                                   scale3(add3(abs3(light_c(l)), abs3(a)), b.y)));
    vec3 error = emitter_corners_error(l, p, scale3(size, GAMMA(7.f)));
    EmitterSample s = emitter_area_finish(l, p, q, error, light_corners_normal(l));
    return emitter_solid_angle_finish(l, s, wide, seen.solid_angle);
}

FN Real emitter_area_parallelogram_pdf(Light l, vec3 p, vec3 wi, vec3 q) {
    Real seen = emitter_area_parallelogram_seen(l, p).solid_angle;
    return emitter_solid_angle_pdf(l, seen, emitter_area_pdf(l, p, q, light_corners_normal(l)));
}

/// Does the emitter's bright side face against wi at the point q?
FN Mask emitter_area_parallelogram_faces(Light l, vec3 wi, vec3 q) {
    return dot3(light_corners_normal(l), wi) < R(0.);
}
