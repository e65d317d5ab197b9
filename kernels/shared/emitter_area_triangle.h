// A triangle that emits from the side its winding faces: corners a, b, c; `extra` is
// 1 / |cross(b - a, c - a)|. Chosen uniformly by solid angle, or by area where it is seen too small
// for that (solid_angle.h).

/// As seen from p; of solid angle 0 where that is not asked for, and from behind.
FN SphericalTriangle emitter_area_triangle_seen(Light l, vec3 p) {
    vec3 a = sub3(light_a(l), p), b = sub3(light_b(l), p), c = sub3(light_c(l), p);
    vec3 n = cross3(sub3(light_b(l), light_a(l)), sub3(light_c(l), light_a(l)));
    Mask near = near_for_solid_angle(scale3(add3(a, add3(b, c)), R(1. / 3.)), .25f * dot3(n, n)) &
                (dot3(a, n) < R(0.));
    return someLane(near) ? spherical_triangle(b, a, c, near) : spherical_triangle_none();
}

FN EmitterSample emitter_area_triangle_sample(Light l, vec3 p, vec2 u) {
    vec2 b = triangle_uniform(u);
    vec3 a0 = light_a(l), a1 = light_b(l), a2 = light_c(l);
    SphericalTriangle seen = emitter_area_triangle_seen(l, p);
    Mask wide = seen.solid_angle >= R(SOLID_ANGLE_LEAST);
    if (someLane(wide)) {
        vec2 at = plane_coordinates(sub3(a0, p), sub3(a1, a0), sub3(a2, a0),
                                    spherical_triangle_uniform(seen, u));
        // Rounding may put the point outside, which is no place to emit from.
        Real b1 = minR(maxR(at.x, R(0.)), R(1.));
        b.x = sel(wide, b1, b.x);
        b.y = sel(wide, minR(maxR(at.y, R(0.)), R(1.) - b1), b.y);
    }
    vec3 error = scale3(interpolate3(abs3(a0), abs3(a1), abs3(a2), b.x, b.y), GAMMA(7.f));
    EmitterSample s =
        emitter_area_finish(l, p, interpolate3(a0, a1, a2, b.x, b.y),
                            emitter_corners_error(l, p, error), light_corners_normal(l));
    return emitter_solid_angle_finish(l, s, wide, seen.solid_angle);
}

FN Real emitter_area_triangle_pdf(Light l, vec3 p, vec3 wi, vec3 q) {
    Real seen = emitter_area_triangle_seen(l, p).solid_angle;
    return emitter_solid_angle_pdf(l, seen, emitter_area_pdf(l, p, q, light_corners_normal(l)));
}

/// Does the emitter's bright side face against wi at the point q?
FN Mask emitter_area_triangle_faces(Light l, vec3 wi, vec3 q) {
    return dot3(light_corners_normal(l), wi) < R(0.);
}
