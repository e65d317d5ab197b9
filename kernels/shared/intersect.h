// A ray against triangles, boxes, spheres and disks, a Real's worth of primitives at a time.

/// A ray whose axes are renamed so that its direction is largest along z, with the shear that turns
/// it into (0, 0, 1) (Woop, Benthin and Wald 2013, "Watertight ray/triangle intersection").
/// Vertices are renamed by the caller.
typedef struct {
    Real shear_x, shear_y, shear_z;
} RayShear;

typedef struct {
    Mask hit;
    Real t;
    Real b1,
        b2; // barycentrics of the second and third corner; for a disk, coordinates along its edges
} Intersection;

/// Watertight triangle test: corners a, b, c relative to the ray's origin, axes renamed. A ray at a
/// shared edge or vertex hits at least one of the neighbours, for any mesh: the signs of the edge
/// functions are exact. t in ]0, t_max].
FN Intersection intersect_triangle(vec3 a, vec3 b, vec3 c, RayShear ray, Real t_max) {
    Real ax = a.x - ray.shear_x * a.z, ay = a.y - ray.shear_y * a.z;
    Real bx = b.x - ray.shear_x * b.z, by = b.y - ray.shear_y * b.z;
    Real cx = c.x - ray.shear_x * c.z, cy = c.y - ray.shear_y * c.z;
    Real u = difference_of_products(cx, by, cy, bx);
    Real v = difference_of_products(ax, cy, ay, cx);
    Real w = difference_of_products(bx, ay, by, ax);
    Real determinant = u + v + w;
    Mask inside =
        ((u >= R(0.)) & (v >= R(0.)) & (w >= R(0.))) | ((u <= R(0.)) & (v <= R(0.)) & (w <= R(0.)));
    Intersection i;
    i.hit = inside & (determinant != R(0.));
    i.t = R(0.);
    i.b1 = R(0.);
    i.b2 = R(0.);
    if (someLane(i.hit)) {
        Real safe = sel(i.hit, determinant, R(1.));
        Real b0 = u / safe; // barycentrics first: the product of three lengths has the narrower
                            // range of exponents
        i.b1 = v / safe;
        i.b2 = w / safe;
        i.t = ray.shear_z * (b0 * a.z + i.b1 * b.z + i.b2 * c.z);
        i.hit = i.hit & (i.t > R(0.)) & (i.t <= t_max);
    }
    return i;
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

/// Boxes are widened by two units in the last place of their far distance (Ize 2013, "Robust BVH
/// ray traversal"), so that rounding never loses a box that the ray touches.
#define BOX_WIDENING 1.00000024

/// Does the ray meet a box before t_max? near and far are per axis already: (plane - origin) /
/// direction. A ray that lies in a plane gives 0 / 0 there, which constrains nothing: minR and maxR
/// take their second argument where the first is no number.
FN Mask box_overlap(Real near_x, Real near_y, Real near_z, Real far_x, Real far_y, Real far_z,
                    Real t_max) {
    Real near = maxR(near_x, maxR(near_y, maxR(near_z, R(0.))));
    Real far = minR(far_x, minR(far_y, minR(far_z, t_max)));
    return near <= far * R(BOX_WIDENING);
}
