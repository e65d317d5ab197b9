// A ray against spheres, cylinders, disks and boxes, a Real's worth of primitives at a time.

/// Without a hit the rest is of no account.
typedef struct {
    Mask hit;
    Mask back; // seen from there; of what is no triangle but for PRIMITIVE_FLIPPED
    Real t;
    Real rank; // of several hits the one of least rank counts: t, of a back a little more
    // barycentrics of the second and third corner; for a disk, coordinates along its edges
    Real b1, b2;
} Intersection;

typedef struct {
    Mask meets; // without, the rest is of no account
    Real near, far;
} Roots;

/// Where |origin + t direction| is the radius. The root is taken from the foot of the perpendicular
/// (Haines et al. 2019, "Precision improvements for ray/sphere intersection"), which keeps digits
/// for far spheres.
FN Roots sphere_roots(vec3 origin, vec3 direction, Real radius) {
    Real a = dot3(direction, direction);
    Real b = -dot3(origin, direction);
    vec3 foot = add3(origin, scale3(direction, b / a));
    Real half_chord_squared = (radius * radius - dot3(foot, foot)) * a;
    Real o_length = length3(origin);
    Real c = (o_length - radius) * (o_length + radius);
    Real q = b + copysignR(sqrt_nonnegative(half_chord_squared), b);
    Real t0 = c / sel(q == R(0.), R(1.), q), t1 = q / a;
    Roots roots;
    roots.meets = half_chord_squared > R(0.);
    roots.near = minR(t0, t1);
    roots.far = maxR(t0, t1);
    return roots;
}

/// Ray origin relative to the centre; direction of any length.
FN Intersection intersect_sphere(vec3 origin, vec3 direction, Real radius, Real t_max) {
    Roots roots = sphere_roots(origin, direction, radius);
    Intersection i;
    i.back = !(roots.near > R(0.));
    i.t = i.rank = sel(roots.near > R(0.), roots.near, roots.far);
    i.hit = roots.meets & (i.t > R(0.)) & (i.t <= t_max);
    i.b1 = R(0.);
    i.b2 = R(0.);
    return i;
}

/// The cylinder of that radius about a line from the base on, `height` long, without caps; ray
/// origin relative to the base, axis unit. Products with the axis are what lies across it, turned
/// by a quarter: there the cylinder is a circle. A ray along the axis meets nothing.
FN Intersection intersect_cylinder(vec3 origin, vec3 direction, vec3 axis, Real radius, Real height,
                                   Real t_max) {
    Roots roots = sphere_roots(cross3(origin, axis), cross3(direction, axis), radius);
    Real from = dot3(origin, axis), slope = dot3(direction, axis);
    Real at_near = from + roots.near * slope, at_far = from + roots.far * slope;
    Mask near = (roots.near > R(0.)) & (at_near >= R(0.)) & (at_near <= height);
    Mask far = (roots.far > R(0.)) & (at_far >= R(0.)) & (at_far <= height);
    Intersection i;
    i.back = !near;
    i.t = i.rank = sel(near, roots.near, roots.far);
    i.hit = roots.meets & (near | far) & (i.t <= t_max);
    i.b1 = R(0.);
    i.b2 = R(0.);
    return i;
}

/// Where two faces of like distance look opposite ways, the front counts: a back ranks as if it
/// were farther by more than distances are off. That of a triangle is off by 15 u of the distances
/// of its corners (below), and mostly by a fraction of it.
#define BACK_DELAY (16.f * HALF_ULP)

/// What a hit at the end of a ray may rank at most.
FN Real rank_of_end(Real t_max) { return t_max + t_max * (Real)BACK_DELAY; }

/// What is no triangle, with its side of PRIMITIVE_FLIPPED.
FN Intersection ranked(Intersection i, Mask flipped) {
    i.back = (i.back & !flipped) | (flipped & !i.back);
    i.rank = sel(i.back, i.t + i.t * (Real)BACK_DELAY, i.t);
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
    i.back = facing > R(0.);
    i.t = i.rank = dot3(to_centre, n) / sel(crosses, facing, R(1.));
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
// distance: a plane within 2^-40, or 4 u of the origin, then constrains nothing up to there. In the
// frame of a scene (host/flatten/scene_frame.h) rays are shorter than 2^17, so that none has moved
// along such an axis by more.
#define PARALLEL_INVERSE 1.2676506002282294e30f  // 2^100
#define PARALLEL_MARGIN 1.152921504606846976e18f // 2^60

// A box counts where the ray as the triangle test has it, slopes rounded, is inside of it ahead of
// the origin. With u = 2^-24:
//
// Where rays leave a box nothing but the box test's own rounding counts. A triangle is hit where
// that ray passes through it, ahead of its origin, beyond what rounding could change, or, where it
// is settled, through one whose corners are moved by 2^-45 of their distance (intersect_edges.h,
// intersect_triangle.h): so it passes through the box, or beside it by 2^-45 of distances that are
// below 2^8 times the size of the scene. Far planes count as farther by 2^-36 of that size
// (BOX_BEYOND).
//
// Where rays enter it counts besides that what is behind the closest hit is left out: the box must
// begin before the distance t that is found in it, or which of two hits wins would depend on the
// order of the walk. What rounding does to t is more than what it does to boxes. With corners at
// (x_i, y_i, z_i) from the ray's origin, the longest side e of the triangle's box, and barycentrics
// b_i: the edge functions are within 3 u of those of rounded corners, so the ray meets the triangle
// of those. Of the triangle as it is, the point q with the same b_i is beside the ray by a mean of
// the corners' errors, in x by 2 u (sum b_i |sheared x_i| + |slope| sum b_i |z_i|). The b_i and
// their sum with z_i make t off by 15 u of that of sum b_i |z_i|, and the slope is off by u. The
// sheared x_i of a triangle around the ray are below 2 e, sum b_i |z_i| is below |q_z| + e: along x
// the ray is within 18 u |slope q_z| + 22 u e of q at t, and |slope q_z| is how far it has come
// along x. It is not different along y and z, and where edges or sides have been settled the errors
// are smaller. Near planes count as nearer by 32 u (BOX_MARGIN) of the longest side of most
// triangles; the boxes of others, which are much larger than most, are so much larger themselves on
// all sides, and so are those of spheres, disks and cylinders. What is left are 18 u of the
// distance (HIT_WIDENING).

#define BOX_BEYOND 1.4551915228366852e-11f // 2^-36

/// For any hit, which does not depend on the order of the walk: rays that end at a light need not
/// look at its box.
FN TreeSizes blocking_sizes(RenderParams params) {
    TreeSizes s = params.tree_sizes;
    s.side = 0;
    return s;
}

/// One axis of a ray made ready for planes: the distance to the plane at p is p * inverse + offset.
typedef struct {
    Real inverse;                 // of the direction
    Real near_offset, far_offset; // low and high by more than the offset's rounding error
} RaySlab;

/// `largest` is the largest absolute component of the direction. The box test loses nothing that
/// the ray touches: with u = 2^-24 the inverse is off by u, the product origin * inverse by u of
/// itself and an offset by another u, for which the margin is 4 u; what is left are relative errors
/// of the distance, u of the inverse and u of the last rounding, at each end (BOX_WIDENING).
FN RaySlab ray_slab(Real origin, Real direction, Real largest, TreeSizes sizes) {
    RaySlab s;
    Mask slanted = absR(direction) > largest * R(5.421010862427522e-20); // 2^-64
    s.inverse = sel(slanted, R(1.) / direction, copysignR((Real)PARALLEL_INVERSE, direction));
    Real product = origin * s.inverse;
    Real margin = absR(product) * R(2.384185791015625e-7) + // 2^-22
                  sel(slanted, R(0.), (Real)PARALLEL_MARGIN);
    Real before = (Real)(sizes.side * BOX_MARGIN), beyond = (Real)(sizes.extent * BOX_BEYOND);
    s.near_offset = -product - (margin + before * absR(s.inverse));
    s.far_offset = (margin + beyond * absR(s.inverse)) - product;
    return s;
}

/// Of far ends: the relative errors of both ends and of the product itself, 5 u, or, where a plane
/// is subtracted from the origin first, 7 u, and 2 u at each end of the slopes that triangles see.
#define BOX_WIDENING 1.00000095367431640625 // 1 + 16 u

/// A box counts up to this much behind the closest hit: 18 u and 11 u.
#define HIT_WIDENING 1.000003814697265625 // 1 + 64 u

// The t_max of boxes, of the rank of what has been found; any hit leaves no box out for another's.
#define BOX_LIMIT(rank, any_hit) ((any_hit) ? (rank) : (rank) * (float)HIT_WIDENING)

typedef struct {
    Mask meets;
    Real entry; // distance, not below 0
} BoxOverlap;

/// Does the ray meet a box before t_max (BOX_LIMIT)? near and far are distances to its planes, per
/// axis.
FN BoxOverlap box_overlap(Real near_x, Real near_y, Real near_z, Real far_x, Real far_y, Real far_z,
                          Real t_max) {
    BoxOverlap b;
    b.entry = maxR(near_x, maxR(near_y, maxR(near_z, R(0.))));
    Real far = minR(far_x, minR(far_y, minR(far_z, t_max)));
    b.meets = b.entry <= far * R(BOX_WIDENING);
    return b;
}
