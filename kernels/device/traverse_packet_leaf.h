// A packet of rays, what its rays have in common, and the packet against the primitives of a leaf,
// one at a time.

#include "device/traverse_doubt.h"

/// What all rays of a packet have in common: bounds of their origins and inverse directions, and
/// whether they meet the same planes of every box first, and have their largest axis in common.
typedef struct {
    int coherent, one_axis;
    int near_row[3];
    int axis[3]; // x, y, z after renaming, if one_axis
    float near_origin[3], far_origin[3], near_inverse[3], far_inverse[3];
    float near_margin[3], far_margin[3]; // of the distances: see ray_slab
} PacketBounds;

// Of coordinates of origins: twice the margin of a ray's own slabs. What those meet no packet
// leaves out, so that any hit does not depend on the packet either.
#define PACKET_MARGIN 4.76837158203125e-7 // 2^-21

FN PacketBounds packet_bounds(PacketRay r, Mask active, TreeSizes sizes) {
    PacketBounds b;
    float before = sizes.side * BOX_MARGIN, beyond = sizes.extent * BOX_BEYOND;
    b.coherent = 1;
    uint all = maskBits(active);
#define BOUND_AXIS(a, axis)                                                                        \
    {                                                                                              \
        uint negative = maskBits((r.axis.inverse < 0.f) & active);                                 \
        float low = lowestLane(sel(active, r.axis.inverse, (Real)INFINITY));                       \
        float high = highestLane(sel(active, r.axis.inverse, (Real)-INFINITY));                    \
        float first = lowestLane(sel(active, r.origin.axis, (Real)INFINITY));                      \
        float last = highestLane(sel(active, r.origin.axis, (Real)-INFINITY));                     \
        int down = negative != 0;                                                                  \
        b.coherent &= negative == 0 || negative == all;                                            \
        b.near_row[a] = 2 * a + down;                                                              \
        b.near_inverse[a] = down ? high : low;                                                     \
        b.far_inverse[a] = (down ? low : high) * (float)BOX_WIDENING;                              \
        b.near_origin[a] = down ? first : last;                                                    \
        b.far_origin[a] = down ? last : first;                                                     \
        float steepest = down ? -low : high;                                                       \
        float parallel = steepest >= PARALLEL_INVERSE ? PARALLEL_MARGIN : 0.f;                     \
        float rounding = (-first > last ? -first : last) * (float)PACKET_MARGIN;                   \
        b.near_margin[a] = parallel + (before + rounding) * steepest;                              \
        b.far_margin[a] = parallel + (beyond + rounding) * steepest;                               \
    }
    BOUND_AXIS(0, x)
    BOUND_AXIS(1, y)
    BOUND_AXIS(2, z)
    uint x = maskBits(r.z_is_x & active), y = maskBits(r.z_is_y & active);
    b.one_axis = x == all || y == all || (x | y) == 0;
    int z = x ? 0 : y ? 1 : 2;
    b.axis[0] = z == 2 ? 0 : z + 1;
    b.axis[1] = z == 0 ? 2 : z - 1;
    b.axis[2] = z;
    return b;
}

/// Boxes, given by the planes that a coherent packet meets first and last, that some of its rays
/// may meet, and where the first ray may enter them: no ray's way through a box begins before or
/// ends after that of the bounds.
FN BoxOverlap bounds_overlap(const PacketBounds* b, vec3 near, vec3 far) {
#define BOUNDS_DISTANCE(plane, side, a, margin)                                                    \
    fmaR(plane - (Real)b->side##_origin[a], (Real)b->side##_inverse[a], (Real)(margin))
#define BOUNDS_NEAR(a, axis_) BOUNDS_DISTANCE(near.axis_, near, a, -b->near_margin[a])
#define BOUNDS_FAR(a, axis_) BOUNDS_DISTANCE(far.axis_, far, a, b->far_margin[a])
    return box_overlap(BOUNDS_NEAR(0, x), BOUNDS_NEAR(1, y), BOUNDS_NEAR(2, z), BOUNDS_FAR(0, x),
                       BOUNDS_FAR(1, y), BOUNDS_FAR(2, z), (Real)INFINITY);
}

/// The point in column k of three rows, x, y and z.
FN vec3 column(global const float (*rows)[BVH_WIDTH], int k) {
    return v3((Real)rows[0][k], (Real)rows[1][k], (Real)rows[2][k]);
}

/// The corner in column k of three rows, as each ray sees it.
FN vec3 packet_corner(global const float (*rows)[BVH_WIDTH], int k, PacketRay r,
                      const PacketBounds* bounds) {
    if (!bounds->one_axis)
        return shear_corner(rename_axes(r, sub3(column(rows, k), r.origin)), r.shear);
    vec3 p = v3((Real)rows[bounds->axis[0]][k], (Real)rows[bounds->axis[1]][k],
                (Real)rows[bounds->axis[2]][k]);
    return shear_corner(sub3(p, rename_axes(r, r.origin)), r.shear);
}

FN TriangleHit packet_primitive(global const BvhLeaf* leaf, int kind, int k, PacketRay r,
                                const PacketBounds* bounds, float size, Real t, int any_hit) {
    Mask flipped = lanesOf((uint) - ((leaf->primitive[k] >> BVH_SIZE_BIT) & 1));
    if (HAS(shape_sphere) && kind == geometry_sphere)
        return certain_hit(ranked(intersect_sphere(sub3(r.origin, column(leaf->rows, k)),
                                                   r.direction, (Real)leaf->rows[3][k], t),
                                  flipped));
    if (HAS(shape_disk) && kind == geometry_disk)
        return certain_hit(
            ranked(intersect_disk(sub3(column(leaf->rows, k), r.origin), r.direction,
                                  column(leaf->rows + 3, k), column(leaf->rows + 6, k), t),
                   flipped));
    if (HAS(shape_cylinder) && kind == geometry_cylinder)
        return certain_hit(
            ranked(intersect_cylinder(sub3(r.origin, column(leaf->rows, k)), r.direction,
                                      column(leaf->rows + 3, k), (Real)leaf->rows[6][k],
                                      (Real)leaf->rows[7][k], t),
                   flipped));
    Corners s;
    s.a = packet_corner(leaf->rows, k, r, bounds);
    s.b = packet_corner(leaf->rows + 3, k, r, bounds);
    s.c = packet_corner(leaf->rows + 6, k, r, bounds);
    TriangleHit h = triangle_hit(s, r.shear, size, t, any_hit, bounds->coherent);
    return any_hit ? h : ranked_backs(h, s, r.shear);
}

/// Rays that hit something in a leaf, and those for which that has to be settled.
typedef struct {
    Mask found, doubtful;
} LeafRays;

/// Takes where the live rays hit one primitive into `hit`, but for the doubtful.
FN LeafRays packet_take(LeafRays rays, TriangleHit h, int number, Int excluded, Mask live,
                        int any_hit, PacketHit* hit) {
    Mask wanted = live & (excluded != number);
    Mask hits = h.hit & wanted & !h.doubtful;
    if (!any_hit) packet_closer(hit, triangle_intersection(h), number, hits);
    rays.found = rays.found | hits;
    rays.doubtful = rays.doubtful | (h.doubtful & wanted);
    return rays;
}

/// The rays that hit something in a leaf, once those in doubt have seen its candidates again.
FN Mask rays_settled(LeafRays rays, global const BvhLine* leaf, int form, uint candidates,
                     PacketRay r, Int excluded, int any_hit, PacketHit* hit) {
    Mask open = any_hit ? rays.doubtful & !rays.found : rays.doubtful;
    if (!RARELY(someLane(open))) return rays.found;
    PacketRay ray = r; // copies, so that the packet itself may stay in registers
    PacketHit settled = *hit;
    settle_packet(&open, leaf, form, candidates, &ray, &excluded, any_hit, &settled);
    *hit = settled;
    return rays.found | open;
}

/// Triangles whose boxes some ray of a coherent packet may meet.
FN Mask triangles_near(const PacketBounds* b, vec3 p, vec3 q, vec3 r) {
    vec3 near, far;
#define TRIANGLE_BOUNDS(axis_, a)                                                                  \
    {                                                                                              \
        Real low = minR(p.axis_, minR(q.axis_, r.axis_));                                          \
        Real high = maxR(p.axis_, maxR(q.axis_, r.axis_));                                         \
        int down = b->near_row[a] & 1;                                                             \
        near.axis_ = down ? high : low;                                                            \
        far.axis_ = down ? low : high;                                                             \
    }
    TRIANGLE_BOUNDS(x, 0)
    TRIANGLE_BOUNDS(y, 1)
    TRIANGLE_BOUNDS(z, 2)
    return bounds_overlap(b, near, far).meets;
}

/// The triangles of a patch, or with coherent rays those that some ray may meet.
FN uint patch_candidates(global const BvhPatch* patch, const PacketBounds* b, int coherent) {
    PatchCorners corners;
    corners.x = load_table(patch->corner[0]);
    corners.y = load_table(patch->corner[1]);
    corners.z = load_table(patch->corner[2]);
    uint candidates = 0;
    for (int group = 0; group < LANE_GROUPS; group++) {
        Int places = LOAD_INT(patch->triangle + group * LANES);
        Mask counts = (places & ((1 << BVH_PATCH_CORNERS) - 1)) != 0;
        if (coherent)
            counts = counts & triangles_near(b, patch_corner(&corners, places),
                                             patch_corner(&corners, places >> 4),
                                             patch_corner(&corners, places >> 8));
        candidates |= maskBits(counts) << (group * LANES);
    }
    return candidates;
}

/// The primitives of a leaf, or with coherent rays those that some ray may meet.
FN uint leaf_candidates(global const BvhLeaf* leaf, const PacketBounds* b, int triangles) {
    uint candidates = 0;
    for (int group = 0; group < LANE_GROUPS; group++) {
        Mask counts = LOAD_INT(leaf->primitive + group * LANES) >= 0;
        if (triangles && b->coherent)
            counts = counts & triangles_near(b, v3(LEAF_ROW(0), LEAF_ROW(1), LEAF_ROW(2)),
                                             v3(LEAF_ROW(3), LEAF_ROW(4), LEAF_ROW(5)),
                                             v3(LEAF_ROW(6), LEAF_ROW(7), LEAF_ROW(8)));
        candidates |= maskBits(counts) << (group * LANES);
    }
    return candidates;
}

/// Takes the hits of a patch. Coherent rays meet few of its triangles; others nearly all, for which
/// the corners are made ready at once.
FN Mask packet_patch(global const BvhPatch* patch, PacketRay r, const PacketBounds* bounds,
                     int coherent, Int excluded, Mask live, int any_hit, PacketHit* hit) {
    vec3 ready[BVH_WIDTH];
    for (int k = 0; k < BVH_WIDTH && !coherent; k++)
        ready[k] = packet_corner(patch->corner, k, r, bounds);
    int base = patch_base(patch);
    global const BvhLine* lines = (global const BvhLine*)patch;
    float size = leaf_size(patch->triangle);
    uint candidates = patch_candidates(patch, bounds, coherent);
    LeafRays rays = {lanesOf(0), lanesOf(0)};
#define READY_CORNER(place)                                                                        \
    (coherent ? packet_corner(patch->corner, place, r, bounds) : ready[place])
    for (uint bits = candidates; bits; bits &= bits - 1) {
        int k = lowest_bit(bits), places = patch->triangle[k];
        Corners s;
        s.a = READY_CORNER(places & 15);
        s.b = READY_CORNER((places >> 4) & 15);
        s.c = READY_CORNER((places >> 8) & 15);
        TriangleHit h = triangle_hit(s, r.shear, size, hit->rank, any_hit, coherent);
        if (coherent && !someLane(h.hit | h.doubtful)) {
            candidates &= ~(1u << k);
            continue;
        }
        if (!any_hit) h = ranked_backs(h, s, r.shear);
        rays = packet_take(rays, h, patch_number(patch, base, k), excluded, live, any_hit, hit);
    }
    return rays_settled(rays, lines, BVH_PATCH, candidates, r, excluded, any_hit, hit);
}

/// Takes the hits of one leaf into `hit`; returns the rays that have one. Coherent rays mostly miss
/// a primitive together; of others there is nearly always one that hits, so that no branch pays.
FN Mask packet_leaf(global const BvhLine* lines, int form, PacketRay r, const PacketBounds* bounds,
                    Int excluded, Mask live, int any_hit, PacketHit* hit) {
    if (form == BVH_PATCH)
        return bounds->coherent ? packet_patch((global const BvhPatch*)lines, r, bounds, 1,
                                               excluded, live, any_hit, hit)
                                : packet_patch((global const BvhPatch*)lines, r, bounds, 0,
                                               excluded, live, any_hit, hit);
    global const BvhLeaf* leaf = (global const BvhLeaf*)lines;
    float size = form == geometry_triangle ? leaf_size(leaf->primitive) : 0.f;
    uint candidates = leaf_candidates(leaf, bounds, form == geometry_triangle);
    LeafRays rays = {lanesOf(0), lanesOf(0)};
    for (uint bits = candidates; bits; bits &= bits - 1) {
        int k = lowest_bit(bits), number = BVH_LEAF_NUMBER(leaf->primitive[k]);
        TriangleHit h = packet_primitive(leaf, form, k, r, bounds, size, hit->rank, any_hit);
        if (bounds->coherent && !someLane(h.hit | h.doubtful)) {
            candidates &= ~(1u << k);
            continue;
        }
        rays = packet_take(rays, h, number, excluded, live, any_hit, hit);
    }
    return rays_settled(rays, lines, form, candidates, r, excluded, any_hit, hit);
}
