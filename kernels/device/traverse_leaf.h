// One ray against the primitives of a leaf, LANES of them at a time.

#include "device/traversal_ray.h"

#define LANE_GROUPS (BVH_WIDTH / LANES)

/// Where a leaf's child code says that it is; its form there: BVH_LEAF_FORM.
FN global const BvhLine* leaf_at(global const BvhLine* leaves, int code) {
    return IN_BUFFER(global const BvhLine, leaves, BVH_LEAF_LINE(code));
}

#define LEAF_ROW(row) LOAD_REAL(leaf->rows[row] + group * LANES)

/// The longest side of the triangles of a leaf, along an axis, rounded up (BVH_SIZE_BIT); of its
/// primitives' words.
FN float leaf_size(global const int* words) {
    uint bits = 0;
    for (int group = 0; group < LANE_GROUPS; group++)
        bits |= maskBits((LOAD_INT(words + group * LANES) << (31 - BVH_SIZE_BIT)) < 0)
                << (group * LANES);
    return as_float(bits << 16);
}

/// Corners are sheared, `size` is leaf_size. For any hit only whether there is one. `rarely`: most
/// often no lane is inside the triangle, so that a branch pays. What is doubtful the caller has
/// settled (traverse_doubt.h).
FN TriangleHit triangle_hit(Corners s, RayShear ray, float size, Real t_max, int any_hit,
                            int rarely) {
    TriangleEdges e = triangle_edges(s, edge_margin_within(s.a.z, size));
    if (any_hit) return triangle_blocks(e, s, ray, t_max);
    if (rarely && !someLane(e.inside)) {
        TriangleHit none;
        none.hit = none.doubtful = lanesOf(0);
        none.t = none.rank = none.b1 = none.b2 = none.volume = none.determinant = R(0.);
        return none;
    }
    return triangle_distance(e, s, ray, t_max);
}

/// With the rank of backs as intersect_triangle has it; `s`: corners, sheared.
FN TriangleHit ranked_backs(TriangleHit h, Corners s, RayShear ray) {
    Real behind = h.t + back_delay(s.a.z, s.b.z, s.c.z, ray.shear_z);
    h.rank = sel(sees_back(h.determinant, ray), behind, h.t);
    return h;
}

/// What is no triangle, of whose hits none is doubtful. The determinant is negative where its back
/// is seen.
FN TriangleHit certain_hit(Intersection i) {
    TriangleHit h;
    h.hit = i.hit;
    h.doubtful = lanesOf(0);
    h.t = i.t, h.rank = i.rank, h.b1 = i.b1, h.b2 = i.b2;
    h.volume = R(0.);
    h.determinant = sel(i.back, R(-1.), R(1.));
    return h;
}

/// A corner whose coordinates are already in the order of the ray's axes.
FN vec3 single_corner(vec3 p, RayShear shear) { return shear_corner(sub3(p, shear.origin), shear); }

FN RayShear single_shear(const TraversalRay* ray) {
    RayShear shear;
    shear.origin = v3((Real)ray->origin[ray->axis[0]], (Real)ray->origin[ray->axis[1]],
                      (Real)ray->origin[ray->axis[2]]);
    shear.shear_x = (Real)ray->shear[0];
    shear.shear_y = (Real)ray->shear[1];
    shear.shear_z = (Real)ray->shear[2];
    shear.doubt = (Real)ray->doubt;
    return shear;
}

FN TriangleHit leaf_triangles(global const BvhLeaf* leaf, int group, const TraversalRay* ray,
                              float size, float t_max, int any_hit) {
    int x = ray->axis[0], y = ray->axis[1], z = ray->axis[2];
    RayShear shear = single_shear(ray);
#define LEAF_CORNER(first)                                                                         \
    single_corner(v3(LEAF_ROW(first + x), LEAF_ROW(first + y), LEAF_ROW(first + z)), shear)
    Corners s;
    s.a = LEAF_CORNER(0);
    s.b = LEAF_CORNER(3);
    s.c = LEAF_CORNER(6);
    return triangle_hit(s, shear, size, (Real)t_max, any_hit, 0);
}

/// The corners of a patch as the ray sees them.
typedef struct {
    Table x, y, z;
} PatchCorners;

FN void patch_corners(global const BvhPatch* patch, const TraversalRay* ray, PatchCorners* c) {
    RayShear shear = single_shear(ray);
    for (int part = 0; part < TABLE_PARTS; part++) {
#define PATCH_ROW(axis_) LOAD_REAL(patch->corner[ray->axis[axis_]] + part * LANES)
        vec3 p = single_corner(v3(PATCH_ROW(0), PATCH_ROW(1), PATCH_ROW(2)), shear);
        c->x.part[part] = p.x, c->y.part[part] = p.y, c->z.part[part] = p.z;
    }
}

FN vec3 patch_corner(const PatchCorners* c, Int place) {
    return v3(look_up(&c->x, place), look_up(&c->y, place), look_up(&c->z, place));
}

FN TriangleHit patch_triangles(global const BvhPatch* patch, const PatchCorners* corners, int group,
                               const TraversalRay* ray, float size, float t_max, int any_hit) {
    Int places = LOAD_INT(patch->triangle + group * LANES);
    Corners s;
    s.a = patch_corner(corners, places);
    s.b = patch_corner(corners, places >> 4);
    s.c = patch_corner(corners, places >> 8);
    TriangleHit h = triangle_hit(s, single_shear(ray), size, (Real)t_max, any_hit, 0);
    // Where none is, three times the same corner: at no time inside, but open.
    h.doubtful = h.doubtful & ((places & ((1 << BVH_PATCH_CORNERS) - 1)) != 0);
    return h;
}

/// What the numbers of a patch's triangles count from.
FN int patch_base(global const BvhPatch* patch) {
    uint bits = 0;
    for (int group = 0; group < LANE_GROUPS; group++)
        bits |= maskBits(LOAD_INT(patch->triangle + group * LANES) < 0) << (group * LANES);
    return (int)(bits << BVH_PATCH_BASE);
}

FN int patch_number(global const BvhPatch* patch, int base, int k) {
    return base + ((patch->triangle[k] >> BVH_PATCH_CORNERS) & ((1 << BVH_PATCH_NUMBERS) - 1));
}

FN vec3 splat_ray(const float* v) { return v3((Real)v[0], (Real)v[1], (Real)v[2]); }

FN Intersection leaf_spheres(global const BvhLeaf* leaf, int group, const TraversalRay* ray,
                             float t_max) {
    vec3 centre = v3(LEAF_ROW(0), LEAF_ROW(1), LEAF_ROW(2));
    return intersect_sphere(sub3(splat_ray(ray->origin), centre), splat_ray(ray->direction),
                            LEAF_ROW(3), (Real)t_max);
}

FN Intersection leaf_disks(global const BvhLeaf* leaf, int group, const TraversalRay* ray,
                           float t_max) {
    vec3 centre = v3(LEAF_ROW(0), LEAF_ROW(1), LEAF_ROW(2));
    vec3 edge_u = v3(LEAF_ROW(3), LEAF_ROW(4), LEAF_ROW(5)),
         edge_v = v3(LEAF_ROW(6), LEAF_ROW(7), LEAF_ROW(8));
    return intersect_disk(sub3(centre, splat_ray(ray->origin)), splat_ray(ray->direction), edge_u,
                          edge_v, (Real)t_max);
}

FN Intersection leaf_cylinders(global const BvhLeaf* leaf, int group, const TraversalRay* ray,
                               float t_max) {
    vec3 base = v3(LEAF_ROW(0), LEAF_ROW(1), LEAF_ROW(2)),
         axis = v3(LEAF_ROW(3), LEAF_ROW(4), LEAF_ROW(5));
    return intersect_cylinder(sub3(splat_ray(ray->origin), base), splat_ray(ray->direction), axis,
                              LEAF_ROW(6), LEAF_ROW(7), (Real)t_max);
}

// Of what is no triangle.
#define LEAF_FLIPPED ((LOAD_INT(leaf->primitive + group * LANES) << (31 - BVH_SIZE_BIT)) < 0)

FN TriangleHit leaf_group(global const BvhLeaf* leaf, int kind, int group, const TraversalRay* ray,
                          float size, float t_max, int any_hit) {
    if (HAS(shape_sphere) && kind == geometry_sphere)
        return certain_hit(ranked(leaf_spheres(leaf, group, ray, t_max), LEAF_FLIPPED));
    if (HAS(shape_disk) && kind == geometry_disk)
        return certain_hit(ranked(leaf_disks(leaf, group, ray, t_max), LEAF_FLIPPED));
    if (HAS(shape_cylinder) && kind == geometry_cylinder)
        return certain_hit(ranked(leaf_cylinders(leaf, group, ray, t_max), LEAF_FLIPPED));
    return leaf_triangles(leaf, group, ray, size, t_max, any_hit);
}

FN int leaf_number(global const BvhLine* leaf, int form, int k) {
    global const BvhPatch* patch = (global const BvhPatch*)leaf;
    if (form == BVH_PATCH) return patch_number(patch, patch_base(patch), k);
    return BVH_LEAF_NUMBER(((global const BvhLeaf*)leaf)->primitive[k]);
}
