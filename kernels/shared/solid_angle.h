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
    vec3 start_and_end;    // their sum
    Real volume, rest;     // the solid angle is 2 atan2(volume, rest)
    Real solid_angle;      // sr; 0 for a triangle seen from its own plane
} SphericalTriangle;

FN SphericalTriangle spherical_triangle_none(void) {
    vec3 z = v3(R(0.), R(0.), R(1.));
    SphericalTriangle t;
    t.start = t.apex = t.end = t.start_and_end = z;
    t.rest = R(1.);
    t.volume = t.solid_angle = R(0.);
    return t;
}

FN SphericalTriangle sel_spherical_triangle(Mask m, SphericalTriangle a, SphericalTriangle b) {
    SphericalTriangle t;
    t.start = sel3(m, a.start, b.start);
    t.apex = sel3(m, a.apex, b.apex);
    t.end = sel3(m, a.end, b.end);
    t.start_and_end = sel3(m, a.start_and_end, b.start_and_end);
    t.volume = sel(m, a.volume, b.volume);
    t.rest = sel(m, a.rest, b.rest);
    t.solid_angle = sel(m, a.solid_angle, b.solid_angle);
    return t;
}

/// Twice the area vector of a triangle, up to its sign, from its two shorter sides: of a needle's
/// two long ones the directions nearly agree, and rounding decides how nearly.
FN vec3 triangle_cross(vec3 a, vec3 b, vec3 c) {
    vec3 ab = sub3(b, a), bc = sub3(c, b), ca = sub3(a, c);
    Real ab_squared = dot3(ab, ab), bc_squared = dot3(bc, bc), ca_squared = dot3(ca, ca);
    Mask without_ab = (ab_squared >= bc_squared) & (ab_squared >= ca_squared);
    Mask without_bc = bc_squared >= ca_squared;
    return cross3(sel3(without_ab, bc, ab), sel3(without_ab | without_bc, ca, bc));
}

/// Where the ends of a side are further apart than this cosine, rounding of their sum would show.
#define NEARLY_OPPOSITE -.875

/// Puts the side whose ends are the furthest apart from start to end in `opposite` lanes, since
/// seen from one of its ends nearly all arcs would run to the other one. Their sum is
/// (b - a) x (a x b) / (1 - a . b), which keeps the digits that a + b loses.
FN_APART SphericalTriangle widest_side_last(SphericalTriangle t, vec3 start, vec3 apex, vec3 end,
                                            Mask opposite) {
    Real start_apex = dot3(t.start, t.apex), apex_end = dot3(t.apex, t.end),
         start_end = dot3(t.start, t.end);
    Mask to_apex = opposite & (start_apex < start_end) & (start_apex <= apex_end),
         from_apex = opposite & (apex_end < start_end) & !to_apex;
    vec3 first = sel3(from_apex, apex, start), last = sel3(to_apex, apex, end);
    vec3 middle = sel3(to_apex, t.end, sel3(from_apex, t.start, t.apex));
    t.start = sel3(from_apex, t.apex, t.start);
    t.end = sel3(to_apex, t.apex, t.end);
    t.apex = middle;
    vec3 chord = sub3(t.end, t.start);
    Real lengths = sel(opposite, length3(first) * length3(last), R(1.));
    vec3 sum = scale3(cross3(chord, cross3(first, last)), 2.f / (dot3(chord, chord) * lengths));
    t.start_and_end = sel3(opposite, sum, t.start_and_end);
    return t;
}

/// Corners relative to the point they are seen from. The solid angle is that of Van Oosterom and
/// Strackee 1983, with the volume from the differences of the corners, which keeps its digits for
/// small triangles (relative error below 2e-6), and the rest from the sum of two directions, which
/// keeps them next to a side. Solid angle 0 where nobody asks for it.
FN SphericalTriangle spherical_triangle(vec3 start, vec3 apex, vec3 end, Mask asked) {
    Real s = length3(start), a = length3(apex), e = length3(end);
    Real product = s * a * e;
    Mask apart = asked & (product > R(0.));
    Real safe = sel(apart, product, R(1.));
    Real volume = absR(dot3(start, triangle_cross(start, apex, end)));
    SphericalTriangle t;
    t.start = scale3(start, R(1.) / sel(apart, s, R(1.)));
    t.apex = scale3(apex, R(1.) / sel(apart, a, R(1.)));
    t.end = scale3(end, R(1.) / sel(apart, e, R(1.)));
    t.volume = sel(apart, volume, R(0.)) / safe;
    t.start_and_end = add3(t.start, t.end);
    Real widest = minR(dot3(t.start, t.end), minR(dot3(t.start, t.apex), dot3(t.apex, t.end)));
    Mask opposite = apart & (widest < R(NEARLY_OPPOSITE));
    if (someLane(opposite)) t = widest_side_last(t, start, apex, end, opposite);
    t.rest = .5f * dot3(t.start_and_end, t.start_and_end) + dot3(t.start_and_end, t.apex);
    t.solid_angle = sel(apart, 2.f * atan2R(t.volume, t.rest), R(0.));
    return t;
}

/// Unit direction uniform in the triangle, whose solid angle is positive.
FN vec3 spherical_triangle_uniform(SphericalTriangle t, vec2 u) {
    // The part of the triangle between start, apex and `cut`, a point of the far side, has the
    // share u.x of the solid angle. `half_way` lies midway between start and cut: Peters' point,
    // written with the sum of start and end.
    SinCos part = sincos_turns(.5f * u.x * t.solid_angle * R(INV_TWO_PI));
    Real along = t.volume * part.cosine - t.rest * part.sine;
    vec3 start_and_apex = add3(t.start, t.apex);
    Real across = .5f * dot3(start_and_apex, start_and_apex) * part.sine;
    vec3 half_way = add3(scale3(t.start, along), scale3(t.start_and_end, across));
    vec3 cut =
        sub3(scale3(half_way, 2.f * dot3(t.start, half_way) / dot3(half_way, half_way)), t.start);
    // On the arc from apex to cut the cosine of the angle from apex falls evenly.
    vec3 chord = sub3(cut, t.apex);
    Real drop = .5f * dot3(chord, chord); // 1 - cosine of the whole arc
    vec3 aside = add3(chord, scale3(t.apex, drop));
    Real aside_squared = dot3(aside, aside);
    Mask bends = aside_squared > R(0.);
    Real fallen = u.y * drop;
    Real r = sqrt_nonnegative(fallen * (2.f - fallen) / sel(bends, aside_squared, R(1.)));
    return add3(scale3(t.apex, R(1.) - fallen), scale3(aside, r));
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
