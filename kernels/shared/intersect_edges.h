// Which side of the edges of a triangle a ray passes: in single precision, and where rounding
// leaves that open from the corners with twice the digits.
//
// With u = 2^-24, of a corner at (px, py, pz) from the ray's origin, axes renamed so that |slope|
// <= 1: the differences are off by u of themselves, the sheared coordinate x = px - slope * pz by u
// of itself besides, so by u (|px| + |slope pz| + |x|) <= 2 u (|x| + |pz|). Let A be the largest
// |x| and |y|, Z the largest |z| of the corners. An edge function, cx by - cy bx, is off by 4 A
// times that, and by 3 u of itself in its own roundings: 8 u A (A + Z) + 6 u A^2 in all, below
// edge_margin. Beyond it the signs stand. Within it they are taken from the corners, sheared with
// an error of 2^-45 (A + Z) instead: one for all triangles that share a corner, from which the
// signs are exact. So the mesh that all of these tests are of is a closed one, whose corners are
// moved by 2^-45 of their distance: nothing leaks out of a closed mesh of whatever triangles if the
// ray starts farther than that from it.
//
// Which triangles are in doubt a bound tells for all triangles of a leaf, none of which has a side
// (along an axis) longer than `size`: the ray passes inside of one, or beside it by e = 2 u (A + Z)
// at most, only where A <= 2 (size + e), and Z <= |z of a corner| + size. edge_margin_within is
// above edge_margin then.

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

/// A triangle as a ray sees it: edge functions, whose signs say on which side of each edge the ray
/// passes.
typedef struct {
    Mask inside; // with the open
    Mask open;   // rounding leaves it open
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

FN Real largest_of(Real a, Real b, Real c) { return maxR(absR(a), maxR(absR(b), absR(c))); }

// What is added to margins is for edge functions that are denormal.
#define EDGE_UNDERFLOW R(1e-36)

/// A bound of the error of a triangle's edge functions; corners are sheared.
FN Real edge_margin(Corners s) {
    Real across = maxR(largest_of(s.a.x, s.b.x, s.c.x), largest_of(s.a.y, s.b.y, s.c.y));
    Real along = largest_of(s.a.z, s.b.z, s.c.z);
    return across * (Real)(16.f * HALF_ULP) * (across + along) + EDGE_UNDERFLOW;
}

/// The same for any triangle no side of which is longer than `size`, with a corner at z, that the
/// ray may be inside of: 32 u D (|z| + 4 D), D = size + 4 u |z|, multiplied out and rounded up.
FN Real edge_margin_within(Real z, Scalar size) {
    Real reach = absR(z);
    Real slope = fmaR(reach, (Real)(132.f * HALF_ULP * HALF_ULP), (Real)(33.f * HALF_ULP * size));
    return fmaR(reach, slope, (Real)(130.f * HALF_ULP * size * size + 1e-36f));
}

/// Of sheared corners. The edge functions are within 3 u of those of the rounded corners.
FN TriangleEdges triangle_edges(Corners s, Real margin) {
    TriangleEdges e;
    e.u = difference_of_products(s.c.x, s.b.y, s.c.y, s.b.x);
    e.v = difference_of_products(s.a.x, s.c.y, s.a.y, s.c.x);
    e.w = difference_of_products(s.b.x, s.a.y, s.b.y, s.a.x);
    e.determinant = e.u + e.v + e.w;
    Real low = minR(e.u, minR(e.v, e.w)), high = maxR(e.u, maxR(e.v, e.w));
    Real within = maxR(low, -high); // of edges all of one sign the least
    e.inside = within >= -margin;
    e.open = absR(within) <= margin;
    return e;
}

/// p - slope * z, off by a few 2^-48 of both.
FN TwoReal two_sheared(TwoReal p, TwoReal z, Real slope) {
    Real moved = slope * z.high;
    Real moved_low = fmaR(slope, z.high, -moved) + slope * z.low;
    TwoReal x = two_difference(p.high, moved);
    return two_difference(x.high, -(x.low + (p.low - moved_low)));
}

/// Of corners as they are: signs without error, of corners sheared with twice the digits. Lengths
/// are divided by a power of two first, so that nothing overflows or is lost.
FN TriangleEdges exact_edges(Corners v, RayShear ray) {
    TwoReal3 p[3];
    p[0] = two_difference3(v.a, ray.origin);
    p[1] = two_difference3(v.b, ray.origin);
    p[2] = two_difference3(v.c, ray.origin);
    Real size = maxR(max_component(abs3(high3(p[0]))),
                     maxR(max_component(abs3(high3(p[1]))), max_component(abs3(high3(p[2])))));
    size = powerOfTwoBelow(size);
    size = sel(size > R(0.), size, R(1.));
    TwoReal x[3], y[3];
    for (int k = 0; k < 3; k++) {
        TwoReal3 q = two_scale3(p[k], R(1.) / size);
        x[k] = two_sheared(q.x, q.z, ray.shear_x);
        y[k] = two_sheared(q.y, q.z, ray.shear_y);
    }
    Real edge[3];
    for (int k = 0; k < 3; k++) {
        int i = (k + 2) % 3, j = (k + 1) % 3;
        edge[k] = signed_difference_of_products(x[i], y[j], y[i], x[j]);
    }
    Mask left = (edge[0] >= R(0.)) & (edge[1] >= R(0.)) & (edge[2] >= R(0.));
    Mask right = (edge[0] <= R(0.)) & (edge[1] <= R(0.)) & (edge[2] <= R(0.));
    TriangleEdges e;
    e.u = edge[0] * size * size, e.v = edge[1] * size * size, e.w = edge[2] * size * size;
    e.determinant = e.u + e.v + e.w;
    e.inside = (left | right) & (e.determinant != R(0.));
    e.open = lanesOf(0);
    return e;
}

FN TriangleEdges sel_edges(Mask m, TriangleEdges a, TriangleEdges b) {
    TriangleEdges e;
    e.inside = (m & a.inside) | (b.inside & !m);
    e.open = (m & a.open) | (b.open & !m);
    e.u = sel(m, a.u, b.u);
    e.v = sel(m, a.v, b.v);
    e.w = sel(m, a.w, b.w);
    e.determinant = sel(m, a.determinant, b.determinant);
    return e;
}

/// With nothing left open; `s`: the corners sheared.
FN TriangleEdges settled_edges(Corners v, Corners s, RayShear ray) {
    TriangleEdges e = triangle_edges(s, edge_margin(s));
    if (someLane(e.open)) e = sel_edges(e.open, exact_edges(v, ray), e);
    return e;
}
