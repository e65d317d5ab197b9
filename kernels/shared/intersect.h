// A ray against triangles, boxes, spheres and disks, a Real's worth of primitives at a time.

/// A ray whose axes are renamed so that its direction is largest along z, with the shear that turns
/// it into (0, 0, 1) (Woop, Benthin and Wald 2013, "Watertight ray/triangle intersection").
/// Vertices are renamed by the caller.
typedef struct {
    Real shear_x, shear_y, shear_z;
} RayShear;

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

/// A corner relative to the ray's origin, axes renamed, as it is when the ray is the z axis; z is
/// not divided by the ray's length.
FN vec3 shear_corner(vec3 p, RayShear ray) {
    return v3(fmaR(-ray.shear_x, p.z, p.x), fmaR(-ray.shear_y, p.z, p.y), p.z);
}

/// Sheared corners a, b, c. Watertight: a ray at a shared edge or vertex is inside at least one of
/// the neighbours, for any mesh, since the signs are exact.
FN TriangleEdges triangle_edges(vec3 a, vec3 b, vec3 c) {
    TriangleEdges e;
    e.u = difference_of_products(c.x, b.y, c.y, b.x);
    e.v = difference_of_products(a.x, c.y, a.y, c.x);
    e.w = difference_of_products(b.x, a.y, b.y, a.x);
    e.determinant = e.u + e.v + e.w;
    Mask left = (e.u >= R(0.)) & (e.v >= R(0.)) & (e.w >= R(0.));
    Mask right = (e.u <= R(0.)) & (e.v <= R(0.)) & (e.w <= R(0.));
    e.inside = (left | right) & (e.determinant != R(0.));
    return e;
}

/// Where the ray meets the plane of a triangle (sheared corners) that it is inside of; t in ]0,
/// t_max].
FN Intersection triangle_distance(TriangleEdges e, vec3 a, vec3 b, vec3 c, RayShear ray,
                                  Real t_max) {
    // Barycentrics first: the product of three lengths would need more exponents than there are.
    Real scale = R(1.) / sel(e.inside, e.determinant, R(1.));
    Real b0 = e.u * scale;
    Intersection i;
    i.b1 = e.v * scale;
    i.b2 = e.w * scale;
    i.t = ray.shear_z * (b0 * a.z + i.b1 * b.z + i.b2 * c.z);
    i.hit = e.inside & (i.t > R(0.)) & (i.t <= t_max);
    return i;
}

/// The watertight triangle test: corners as for shear_corner; t in ]0, t_max].
FN Intersection intersect_triangle(vec3 a, vec3 b, vec3 c, RayShear ray, Real t_max) {
    a = shear_corner(a, ray), b = shear_corner(b, ray), c = shear_corner(c, ray);
    return triangle_distance(triangle_edges(a, b, c), a, b, c, ray, t_max);
}

/// Whether triangle_distance hits, but for the rounding of t at both ends: without a division.
FN Mask triangle_blocks(TriangleEdges e, vec3 a, vec3 b, vec3 c, RayShear ray, Real t_max) {
    // In units of the ray's own length, so that only two lengths are multiplied.
    Real az = ray.shear_z * a.z, bz = ray.shear_z * b.z, cz = ray.shear_z * c.z;
    Real t = copysignR(R(1.), e.determinant) * (e.u * az + e.v * bz + e.w * cz);
    return e.inside & (t > R(0.)) & (t <= t_max * absR(e.determinant));
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
