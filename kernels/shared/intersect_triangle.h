// A ray against triangles: where it meets one that it is inside of, ahead of its origin or behind
// it.

// ---- ahead of the ray's origin, or behind it
//
// A triangle counts where t > 0, and a ray starts as near to triangles as their neighbours are: the
// rounding of t must not decide. The sign of t is that of the volume u z_a + v z_b + w z_c over
// that of the determinant, and the volume is which side of the triangle's plane the origin is on.
// Where |volume| is above a bound of its error, its sign stands; else the side is computed from the
// corners themselves with twice the digits. The determinant keeps the sign that the edges
// saw. So nothing leaks for the sake of exactness: of a closed convex mesh, the planes of all
// triangles lie to the same side of an origin inside it; the line through it is inside of as many
// that it sees from the front as from the back, and one kind lies ahead.
//
// The bound, with u = 2^-24 and X, Y, Z the largest |x|, |y|, |z| of the sheared corners: a
// difference to the origin is off by u of itself, a sheared coordinate by another u of itself and
// of its two parts, which makes 2 u (X + Z) in x, 2 u (Y + Z) in y, u Z in z; six products of one
// of each: 30 u (X + Z) (Y + Z) Z. The edge functions are off by 3 u of themselves, and forming the
// volume from them (or t, and back) by no more than 8 u: at most 4 X Y Z each time, 44 u X Y Z. All
// of it is below 128 u (X + Z) (Y + Z) Z.
//
// For most triangles no more is computed than the comparison with `doubt`, a bound for all of them.
// If the corners of a triangle all lie ahead, or all behind, along the ray's largest axis, then so
// does what it hits, for the signs of differences are exact: the bound matters only to triangles
// on both sides. Those have Z <= L, X <= 2 L, Y <= 2 L if L is the longest side of a box around
// all, since x = y = z = 0 is then within their reach: 9 L^3 * 128 u.

/// Of |volume| times |shear_z| a bound for the rounding errors of all triangles in a box whose
/// longest side is `extent`. What is added is for volumes that are denormal.
FN Real ray_doubt(Real shear_z, Real extent) {
    Real volume = extent * extent * (extent * R(1.220703125e-4)); // 2^-13 > 9 * 128 u
    return absR(shear_z) * (volume + R(1e-36));
}

/// Whether the corners lie on both sides of the origin along the ray's largest axis.
FN Mask straddles_origin(Corners s) {
    return signsDiffer(s.a.z, s.b.z) | signsDiffer(s.a.z, s.c.z);
}

/// Whether the bound leaves the sign of `volume` (times shear_z) open.
FN Mask volume_uncertain(Corners s, RayShear ray, Real volume) {
    Real x = largest_of(s.a.x, s.b.x, s.c.x), y = largest_of(s.a.y, s.b.y, s.c.y),
         z = largest_of(s.a.z, s.b.z, s.c.z);
    Real bound = (x + z) * (y + z) * (z * absR(ray.shear_z) * R(7.62939453125e-6)); // 128 u
    return !(absR(volume) > bound + R(1e-36)); // below, digits are lost to underflow
}

typedef struct {
    Mask ahead;
    Real t; // not negative
} PlaneSide;

/// Where the plane of a triangle is from the ray's origin. The volume is right to 2^-42 of the
/// products of lengths that it is made of; 0 where the origin is in a plane across an axis. Lengths
/// are divided by powers of two first, so that nothing overflows or is lost.
FN PlaneSide plane_side(Corners v, RayShear ray, Real determinant) {
    TwoReal3 e = two_difference3(v.c, v.a), f = two_difference3(v.b, v.a),
             g = two_difference3(v.a, ray.origin);
    Real size = powerOfTwoBelow(maxR(max_component(abs3(high3(e))), max_component(abs3(high3(f)))));
    Real away = powerOfTwoBelow(max_component(abs3(high3(g))));
    size = sel(size > R(0.), size, R(1.));
    away = sel(away > R(0.), away, R(1.));
    TwoReal3 n = two_cross3(two_scale3(e, R(1.) / size), two_scale3(f, R(1.) / size));
    Real volume = two_dot3(n, two_scale3(g, R(1.) / away)).high;
    Real facing = two_add(two_add(two_multiply(n.x, two_real(ray.shear_x, R(0.))),
                                  two_multiply(n.y, two_real(ray.shear_y, R(0.)))),
                          n.z)
                      .high;
    PlaneSide p;
    p.ahead = sel(signsDiffer(determinant, ray.shear_z), volume<R(0.), volume> R(0.));
    p.t = absR(ray.shear_z * (away * (volume / sel(facing == R(0.), R(1.), facing))));
    return p;
}

/// Whether the ray sees the back of a triangle that it has ahead.
FN Mask sees_back(Real determinant, RayShear ray) { return signsDiffer(determinant, ray.shear_z); }

/// How much farther a back ranks (BACK_DELAY), from z of the sheared corners.
FN Real back_delay(Real a, Real b, Real c, Real shear_z) {
    return largest_of(a, b, c) * (absR(shear_z) * (Real)BACK_DELAY);
}

/// A triangle that a ray may be inside of, before it is settled whether it is, and on which side of
/// the origin.
typedef struct {
    Mask hit;      // but for the doubtful
    Mask doubtful; // whatever t_max is: intersect_triangle must say
    Real t, b1, b2;
    Real rank; // t, until a back is told apart
    Real volume, determinant;
} TriangleHit;

/// Where the ray meets the plane of a triangle that it is inside of; t in ]0, t_max].
FN TriangleHit triangle_distance(TriangleEdges e, Corners s, RayShear ray, Real t_max) {
    // Barycentrics first: the product of three lengths would need more exponents than there are.
    Real scale = R(1.) / e.determinant; // of no account where nothing is hit
    Real b0 = e.u * scale;
    TriangleHit h;
    h.b1 = e.v * scale;
    h.b2 = e.w * scale;
    h.t = h.rank = ray.shear_z * (b0 * s.a.z + h.b1 * s.b.z + h.b2 * s.c.z);
    h.determinant = e.determinant;
    h.volume = h.t * absR(e.determinant);
    h.hit = e.inside & (h.t <= t_max) & (h.t > R(0.));
    h.doubtful =
        e.inside & (e.open | (straddles_origin(s) & (absR(h.t * e.determinant) <= ray.doubt)));
    return h;
}

/// Whether triangle_distance hits, but for the rounding of t at its far end, and nothing else:
/// without a division.
FN TriangleHit triangle_blocks(TriangleEdges e, Corners s, RayShear ray, Real t_max) {
    // In units of the ray's own length, so that only two lengths are multiplied.
    Real az = ray.shear_z * s.a.z, bz = ray.shear_z * s.b.z, cz = ray.shear_z * s.c.z;
    TriangleHit h;
    h.t = h.rank = h.b1 = h.b2 = R(0.);
    h.determinant = e.determinant;
    h.volume = flipSign(e.u * az + e.v * bz + e.w * cz, e.determinant);
    h.hit = e.inside & (h.volume <= t_max * absR(e.determinant)) & (h.volume > R(0.));
    h.doubtful = e.inside & (e.open | (straddles_origin(s) & (absR(h.volume) <= ray.doubt)));
    return h;
}

/// Takes the doubt about the sides of the origin from a hit: from the corners themselves.
FN TriangleHit triangle_settled(TriangleHit h, TriangleEdges e, Corners s, Corners v, RayShear ray,
                                Real t_max) {
    h.doubtful = e.inside & straddles_origin(s) & volume_uncertain(s, ray, h.volume);
    if (someLane(h.doubtful)) {
        PlaneSide plane = plane_side(v, ray, h.determinant);
        h.t = sel(h.doubtful, plane.t, h.t);
        h.hit = sel(h.doubtful, plane.ahead & (plane.t <= t_max), h.hit);
    }
    return h;
}

FN Intersection triangle_intersection(TriangleHit h) {
    Intersection i;
    i.hit = h.hit;
    i.back = lanesOf(0);
    i.t = h.t;
    i.rank = h.rank;
    i.b1 = h.b1;
    i.b2 = h.b2;
    return i;
}

/// The watertight triangle test; t in ]0, t_max].
FN Intersection intersect_triangle(Corners v, RayShear ray, Real t_max) {
    Corners s = sheared(seen_from(v, ray.origin), ray);
    TriangleEdges e = settled_edges(v, s, ray);
    TriangleHit h = triangle_distance(e, s, ray, t_max);
    h = triangle_settled(h, e, s, v, ray, t_max);
    Real delay =
        sel(h.doubtful, h.t * (Real)BACK_DELAY, back_delay(s.a.z, s.b.z, s.c.z, ray.shear_z));
    Intersection i = triangle_intersection(h);
    i.back = sees_back(h.determinant, ray);
    i.rank = sel(i.back, h.t + delay, h.t);
    return i;
}

/// Whether intersect_triangle hits, but for the rounding of t at its far end.
FN Mask triangle_occludes(Corners v, RayShear ray, Real t_max) {
    Corners s = sheared(seen_from(v, ray.origin), ray);
    TriangleEdges e = settled_edges(v, s, ray);
    TriangleHit h = triangle_blocks(e, s, ray, t_max);
    return triangle_settled(h, e, s, v, ray, t_max).hit;
}
