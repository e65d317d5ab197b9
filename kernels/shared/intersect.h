// A ray against triangles, boxes, spheres and disks, a Real's worth of primitives at a time.

/// A ray whose axes are renamed so that its direction is largest along z, with the shear that turns
/// it into (0, 0, 1) (Woop, Benthin and Wald 2013, "Watertight ray/triangle intersection").
typedef struct {
    vec3 origin;
    Real shear_x, shear_y, shear_z;
    Real doubt; // ray_doubt
} RayShear;

/// Of a triangle, axes renamed as the ray's.
typedef struct {
    vec3 a, b, c;
} Corners;

/// Without a hit the rest is of no account.
typedef struct {
    Mask hit;
    Real t;
    // barycentrics of the second and third corner; for a disk, coordinates along its edges
    Real b1, b2;
} Intersection;

/// A triangle as a ray sees it: edge functions, whose signs say on which side of each edge the ray
/// passes.
typedef struct {
    Mask inside;
    Real u, v, w, determinant;
} TriangleEdges;

FN Corners seen_from(Corners v, vec3 origin) {
    Corners r;
    r.a = sub3(v.a, origin);
    r.b = sub3(v.b, origin);
    r.c = sub3(v.c, origin);
    return r;
}

/// A corner as the ray sees it, from that relative to its origin: x and y across the ray, z as it
/// was, not divided by the ray's length.
FN vec3 shear_corner(vec3 p, RayShear ray) {
    return v3(fmaR(-ray.shear_x, p.z, p.x), fmaR(-ray.shear_y, p.z, p.y), p.z);
}

FN Corners sheared(Corners r, RayShear ray) {
    Corners s;
    s.a = shear_corner(r.a, ray);
    s.b = shear_corner(r.b, ray);
    s.c = shear_corner(r.c, ray);
    return s;
}

/// Of sheared corners. Watertight: a ray at a shared edge or vertex is inside at least one of the
/// neighbours, for any mesh, since the signs are exact.
FN TriangleEdges triangle_edges(Corners s) {
    TriangleEdges e;
    e.u = difference_of_products(s.c.x, s.b.y, s.c.y, s.b.x);
    e.v = difference_of_products(s.a.x, s.c.y, s.a.y, s.c.x);
    e.w = difference_of_products(s.b.x, s.a.y, s.b.y, s.a.x);
    e.determinant = e.u + e.v + e.w;
    Mask left = (e.u >= R(0.)) & (e.v >= R(0.)) & (e.w >= R(0.));
    Mask right = (e.u <= R(0.)) & (e.v <= R(0.)) & (e.w <= R(0.));
    e.inside = (left | right) & (e.determinant != R(0.));
    return e;
}

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

FN Real largest_of(Real a, Real b, Real c) { return maxR(absR(a), maxR(absR(b), absR(c))); }

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
    Real facing = n.x.high * ray.shear_x + n.y.high * ray.shear_y + n.z.high;
    PlaneSide p;
    p.ahead = sel(signsDiffer(determinant, ray.shear_z), volume<R(0.), volume> R(0.));
    p.t = absR(ray.shear_z * (away * (volume / sel(facing == R(0.), R(1.), facing))));
    return p;
}

/// A triangle that a ray is inside of, before it is settled on which side of the origin it is.
typedef struct {
    Mask hit;      // but for the doubtful
    Mask doubtful; // triangle_settled must say
    Real t, b1, b2;
    Real volume, determinant;
} TriangleHit;

/// Where the ray meets the plane of a triangle that it is inside of; t in ]0, t_max].
FN TriangleHit triangle_distance(TriangleEdges e, Corners s, RayShear ray, Real t_max) {
    // Barycentrics first: the product of three lengths would need more exponents than there are.
    Real scale = R(1.) / sel(e.inside, e.determinant, R(1.));
    Real b0 = e.u * scale;
    TriangleHit h;
    h.b1 = e.v * scale;
    h.b2 = e.w * scale;
    h.t = ray.shear_z * (b0 * s.a.z + h.b1 * s.b.z + h.b2 * s.c.z);
    h.determinant = e.determinant;
    h.volume = h.t * absR(e.determinant);
    h.hit = e.inside & (h.t <= t_max);
    h.doubtful = h.hit & straddles_origin(s) & (absR(h.t * e.determinant) <= ray.doubt);
    h.hit = h.hit & (h.t > R(0.));
    return h;
}

/// Whether triangle_distance hits, but for the rounding of t at its far end, and nothing else:
/// without a division.
FN TriangleHit triangle_blocks(TriangleEdges e, Corners s, RayShear ray, Real t_max) {
    // In units of the ray's own length, so that only two lengths are multiplied.
    Real az = ray.shear_z * s.a.z, bz = ray.shear_z * s.b.z, cz = ray.shear_z * s.c.z;
    TriangleHit h;
    h.t = h.b1 = h.b2 = R(0.);
    h.determinant = e.determinant;
    h.volume = copysignR(R(1.), e.determinant) * (e.u * az + e.v * bz + e.w * cz);
    h.hit = e.inside & (h.volume <= t_max * absR(e.determinant));
    h.doubtful = h.hit & straddles_origin(s) & (absR(h.volume) <= ray.doubt);
    h.hit = h.hit & (h.volume > R(0.));
    return h;
}

/// Takes the doubt from a hit: from the corners themselves.
FN TriangleHit triangle_settled(TriangleHit h, Corners v, RayShear ray, Real t_max) {
    Mask uncertain =
        h.doubtful & volume_uncertain(sheared(seen_from(v, ray.origin), ray), ray, h.volume);
    if (someLane(uncertain)) {
        PlaneSide plane = plane_side(v, ray, h.determinant);
        h.t = sel(uncertain, plane.t, h.t);
        h.hit = sel(uncertain, plane.ahead & (plane.t <= t_max), h.hit);
    }
    return h;
}

FN Intersection triangle_intersection(TriangleHit h) {
    Intersection i;
    i.hit = h.hit;
    i.t = h.t;
    i.b1 = h.b1;
    i.b2 = h.b2;
    return i;
}

/// The watertight triangle test; t in ]0, t_max].
FN Intersection intersect_triangle(Corners v, RayShear ray, Real t_max) {
    Corners s = sheared(seen_from(v, ray.origin), ray);
    TriangleHit h = triangle_distance(triangle_edges(s), s, ray, t_max);
    return triangle_intersection(triangle_settled(h, v, ray, t_max));
}

/// Whether intersect_triangle hits, but for the rounding of t at its far end.
FN Mask triangle_occludes(Corners v, RayShear ray, Real t_max) {
    Corners s = sheared(seen_from(v, ray.origin), ray);
    TriangleHit h = triangle_blocks(triangle_edges(s), s, ray, t_max);
    return triangle_settled(h, v, ray, LANE_INFINITY).hit;
}

/// Ray origin relative to the centre; direction of any length. The root is taken from the foot of
/// the perpendicular (Haines et al. 2019, "Precision improvements for ray/sphere intersection"),
/// which keeps digits for far spheres.
FN Intersection intersect_sphere(vec3 origin, vec3 direction, Real radius, Real t_max) {
    Real a = dot3(direction, direction);
    Real b = -dot3(origin, direction);
    vec3 foot = add3(origin, scale3(direction, b / a));
    Real half_chord_squared = (radius * radius - dot3(foot, foot)) * a;
    Real o_length = length3(origin);
    Real c = (o_length - radius) * (o_length + radius);
    Real q = b + copysignR(sqrt_nonnegative(half_chord_squared), b);
    Real t0 = c / sel(q == R(0.), R(1.), q), t1 = q / a;
    Real near = minR(t0, t1), far = maxR(t0, t1);
    Intersection i;
    i.t = sel(near > R(0.), near, far);
    i.hit = (half_chord_squared > R(0.)) & (i.t > R(0.)) & (i.t <= t_max);
    i.b1 = R(0.);
    i.b2 = R(0.);
    return i;
}

/// The disk { a edge_u + b edge_v : a^2 + b^2 <= 1 } about the centre; `to_centre` = centre - ray
/// origin.
FN Intersection intersect_disk(vec3 to_centre, vec3 direction, vec3 edge_u, vec3 edge_v,
                               Real t_max) {
    vec3 n = cross3(edge_u, edge_v);
    Real facing = dot3(direction, n);
    Mask crosses = facing != R(0.);
    Intersection i;
    i.t = dot3(to_centre, n) / sel(crosses, facing, R(1.));
    vec3 p = sub3(scale3(direction, i.t), to_centre);
    Real n_squared = dot3(n, n);
    Mask real_disk = n_squared > R(0.);
    Real scale = R(1.) / sel(real_disk, n_squared, R(1.));
    i.b1 = dot3(cross3(p, edge_v), n) * scale;
    i.b2 = dot3(cross3(edge_u, p), n) * scale;
    i.hit =
        crosses & real_disk & (i.b1 * i.b1 + i.b2 * i.b2 <= R(1.)) & (i.t > R(0.)) & (i.t <= t_max);
    return i;
}

// An axis that a ray is parallel to (up to 2^-64) gets the slope 2^-100 and a margin of the
// distance: a plane within 2^-40, or 4 u of the origin, then constrains nothing up to there.
#define PARALLEL_INVERSE 1.2676506002282294e30f  // 2^100
#define PARALLEL_MARGIN 1.152921504606846976e18f // 2^60

/// One axis of a ray made ready for planes: the distance to the plane at p is p * inverse + offset.
typedef struct {
    Real inverse;                 // of the direction
    Real near_offset, far_offset; // low and high by more than the offset's rounding error
} RaySlab;

/// `largest` is the largest absolute component of the direction. The box test loses nothing that
/// the ray touches: with u = 2^-24 the inverse is off by u, the product origin * inverse by u of
/// itself and an offset by another u, for which the margin is 4 u; what is left are relative errors
/// of the distance, u of the inverse and u of the last rounding, at each end (BOX_WIDENING).
FN RaySlab ray_slab(Real origin, Real direction, Real largest) {
    RaySlab s;
    Mask slanted = absR(direction) > largest * R(5.421010862427522e-20); // 2^-64
    s.inverse = sel(slanted, R(1.) / direction, copysignR((Real)PARALLEL_INVERSE, direction));
    Real product = origin * s.inverse;
    Real margin = absR(product) * R(2.384185791015625e-7) + // 2^-22
                  sel(slanted, R(0.), (Real)PARALLEL_MARGIN);
    s.near_offset = -product - margin;
    s.far_offset = margin - product;
    return s;
}

/// Far ends of boxes are widened by the relative errors of both ends and of the product itself, 5
/// u, or, where a plane is subtracted from the origin first, 7 u (u = 2^-24).
#define BOX_WIDENING 1.000000476837158203125 // 1 + 8 u

/// A box counts up to this much behind the closest hit: the distance to a corner that touches the
/// box is computed by other roundings. Boxes of hits at the same distance must all be looked at, or
/// which of them wins would depend on the order of the walk. 64 u is what the tests at edges and
/// corners hold with, not a proven bound.
#define HIT_WIDENING 1.000003814697265625 // 1 + 64 u

typedef struct {
    Mask meets;
    Real entry; // distance, not below 0
} BoxOverlap;

/// Does the ray meet a box before t_max (widened by HIT_WIDENING already)? near and far are
/// distances to its planes, per axis.
FN BoxOverlap box_overlap(Real near_x, Real near_y, Real near_z, Real far_x, Real far_y, Real far_z,
                          Real t_max) {
    BoxOverlap b;
    b.entry = maxR(near_x, maxR(near_y, maxR(near_z, R(0.))));
    Real far = minR(far_x, minR(far_y, minR(far_z, t_max)));
    b.meets = b.entry <= far * R(BOX_WIDENING);
    return b;
}
