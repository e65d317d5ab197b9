// Triangles and parallelograms seen from a point: their solid angle, and points uniform in it.
//
// Peters 2021, "BRDF Importance Sampling for Polygonal Lights", section 5: no inverse functions but
// one arc tangent.
//
// A shape is chosen by area where it is too far for the difference to be worth its price (a square
// in front of a point 1.4 sides away: a relative variance of one per cent), and where it is seen
// under less than SOLID_ANGLE_LEAST, which is where rounding would begin to show in the directions.

#define SOLID_ANGLE_LEAST 1e-3

/// Is a shape of this area (squared) and with this middle, relative to the point that it is seen
/// from, near enough?
FN Mask near_for_solid_angle(vec3 middle, Real area_squared) {
    return square(dot3(middle, middle)) < 4.f * area_squared;
}

/// A triangle seen from the origin. Arcs from `apex` to the side from `start` to `end` cut off
/// equal solid angles in equal steps of the first random number.
typedef struct {
    vec3 start, apex, end; // unit directions
    Real volume;           // start . (apex x end), its absolute value
    Real solid_angle;      // sr; 0 for a triangle seen from its own plane
} SphericalTriangle;

/// Twice the area vector of a triangle, up to its sign, from its two shorter sides: of a needle's
/// two long ones the directions nearly agree, and rounding decides how nearly.
FN vec3 triangle_cross(vec3 a, vec3 b, vec3 c) {
    vec3 ab = sub3(b, a), bc = sub3(c, b), ca = sub3(a, c);
    Real ab_squared = dot3(ab, ab), bc_squared = dot3(bc, bc), ca_squared = dot3(ca, ca);
    Mask without_ab = (ab_squared >= bc_squared) & (ab_squared >= ca_squared);
    Mask without_bc = bc_squared >= ca_squared;
    return cross3(sel3(without_ab, bc, ab), sel3(without_ab | without_bc, ca, bc));
}

/// Corners relative to the point they are seen from. The solid angle is that of Van Oosterom and
/// Strackee 1983, with the volume from the differences of the corners, which keeps its digits for
/// small triangles (relative error below 2e-6).
FN SphericalTriangle spherical_triangle(vec3 start, vec3 apex, vec3 end) {
    Real s = length3(start), a = length3(apex), e = length3(end);
    Real product = s * a * e;
    Mask apart = product > R(0.);
    Real safe = sel(apart, product, R(1.));
    Real volume = absR(dot3(start, triangle_cross(start, apex, end)));
    Real rest = product + dot3(start, apex) * e + dot3(start, end) * a + dot3(apex, end) * s;
    SphericalTriangle t;
    t.start = scale3(start, R(1.) / sel(apart, s, R(1.)));
    t.apex = scale3(apex, R(1.) / sel(apart, a, R(1.)));
    t.end = scale3(end, R(1.) / sel(apart, e, R(1.)));
    t.volume = sel(apart, volume, R(0.)) / safe;
    t.solid_angle = 2.f * atan2R(volume, rest);
    return t;
}

/// Unit direction uniform in the triangle, whose solid angle is positive.
FN vec3 spherical_triangle_uniform(SphericalTriangle t, vec2 u) {
    // The part of the triangle between start, apex and `cut`, a point of the far side, has the
    // share u.x of the solid angle. `half` lies midway between start and cut.
    SinCos part = sincos_turns(.5f * u.x * t.solid_angle * R(INV_TWO_PI));
    Real along_start =
        t.volume * part.cosine - (dot3(t.start, t.end) + dot3(t.apex, t.end)) * part.sine;
    Real along_end = (R(1.) + dot3(t.start, t.apex)) * part.sine;
    vec3 half_way = add3(scale3(t.start, along_start), scale3(t.end, along_end));
    vec3 cut =
        sub3(scale3(half_way, 2.f * dot3(t.start, half_way) / dot3(half_way, half_way)), t.start);
    // On the arc from apex to cut the cosine of the angle from apex falls evenly.
    vec3 chord = sub3(cut, t.apex);
    Real drop = .5f * dot3(chord, chord); // 1 - cosine of the whole arc
    Real r = sqrt_nonnegative(u.y * (2.f - u.y * drop) / (2.f - drop));
    return add3(scale3(t.apex, R(1.) - u.y * drop), scale3(add3(chord, scale3(t.apex, drop)), r));
}

/// Coordinates (b1, b2) along the edges e1 and e2 of the point of their plane that the direction w
/// meets; `a`: their common corner, relative to where w starts.
FN vec2 plane_coordinates(vec3 a, vec3 e1, vec3 e2, vec3 w) {
    vec3 h = cross3(w, e2);
    Real determinant = dot3(e1, h);
    Mask crosses = determinant != R(0.);
    Real inverse = R(1.) / sel(crosses, determinant, R(1.));
    Real b1 = -dot3(a, h) * inverse, b2 = -dot3(w, cross3(a, e1)) * inverse;
    return v2(sel(crosses, b1, R(0.)), sel(crosses, b2, R(0.)));
}
