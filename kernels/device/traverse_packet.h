// A packet of rays through the wide BVH together: a box or a primitive at a time against all lanes.
//
// The answers are those of traverse(), to the bit; it also takes over where few rays are left.

#include "device/traverse.h"

// Where no more than these are left of a packet, each goes on alone: a packet pays for rays that go
// the same way, or through a small tree.
#define FEW_RAYS 6

typedef struct {
    Real t, b1, b2;
    Int primitive; // NO_PRIMITIVE: nothing
} PacketHit;

/// What all rays of a packet have in common: bounds of their origins and inverse directions, and
/// whether they meet the same planes of every box first, and have their largest axis in common.
typedef struct {
    int coherent, one_axis;
    int near_row[3];
    int axis[3]; // x, y, z after renaming, if one_axis
    float near_origin[3], far_origin[3], near_inverse[3], far_inverse[3];
    float slack[3]; // of the distance, where a ray is parallel to the axis: see ray_slab
} PacketBounds;

FN PacketBounds packet_bounds(PacketRay r, Mask active) {
    PacketBounds b;
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
        b.far_inverse[a] = down ? low : high;                                                      \
        b.near_origin[a] = down ? first : last;                                                    \
        b.far_origin[a] = down ? last : first;                                                     \
        b.slack[a] = low <= -PARALLEL_INVERSE || high >= PARALLEL_INVERSE ? PARALLEL_MARGIN : 0.f; \
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

/// Children that some ray of a coherent packet may meet, and where the first ray may enter them: no
/// ray's way through a box begins before or ends after that of the bounds.
FN uint packet_cull(global const BvhNode* node, const PacketBounds* b, RealLanes* entry) {
    uint candidates = 0;
#define CULL_PLANE(flip, side, a, margin)                                                          \
    fmaR(LOAD_REAL(node->bounds[b->near_row[a] ^ flip] + group * LANES) -                          \
             (Real)b->side##_origin[a],                                                            \
         (Real)b->side##_inverse[a], (Real)(margin))
#define CULL_NEAR(a) CULL_PLANE(0, near, a, -b->slack[a])
#define CULL_FAR(a) CULL_PLANE(1, far, a, b->slack[a])
    for (int group = 0; group < LANE_GROUPS; group++) {
        BoxOverlap box = box_overlap(CULL_NEAR(0), CULL_NEAR(1), CULL_NEAR(2), CULL_FAR(0),
                                     CULL_FAR(1), CULL_FAR(2), (Real)INFINITY);
        candidates |= maskBits(box.meets) << (group * LANES);
        entry[group].lanes = box.entry;
    }
    return candidates;
}

/// Children that are there at all; nothing is known about where rays enter them.
FN uint present_children(global const BvhNode* node, RealLanes* entry) {
    uint present = 0;
    for (int group = 0; group < LANE_GROUPS; group++) {
        present |= maskBits(LOAD_REAL(node->bounds[0] + group * LANES) < (Real)INFINITY)
                   << (group * LANES);
        entry[group].lanes = R(0.);
    }
    return present;
}

#define CHILD_BOX(X, Y, Z)                                                                         \
    box_overlap(fmaR(X(0, 0, x), r.x.inverse, r.x.near_offset),                                    \
                fmaR(Y(1, 0, y), r.y.inverse, r.y.near_offset),                                    \
                fmaR(Z(2, 0, z), r.z.inverse, r.z.near_offset),                                    \
                fmaR(X(0, 1, x), r.x.inverse, r.x.far_offset),                                     \
                fmaR(Y(1, 1, y), r.y.inverse, r.y.far_offset),                                     \
                fmaR(Z(2, 1, z), r.z.inverse, r.z.far_offset), t)                                  \
        .meets

/// Which rays meet child k before t.
FN Mask packet_overlap(global const BvhNode* node, int k, PacketRay r, const PacketBounds* bounds,
                       Real t) {
#define COMMON_PLANE(a, far, axis) (Real) node->bounds[bounds->near_row[a] ^ far][k]
#define OWN_PLANE(a, far, axis)                                                                    \
    sel(r.axis.inverse < 0.f, (Real)node->bounds[2 * a + 1 - far][k],                              \
        (Real)node->bounds[2 * a + far][k])
    if (bounds->coherent) return CHILD_BOX(COMMON_PLANE, COMMON_PLANE, COMMON_PLANE);
    return CHILD_BOX(OWN_PLANE, OWN_PLANE, OWN_PLANE);
}

#define CORNER(first, x, y, z)                                                                     \
    v3((Real)leaf->rows[first + x][k], (Real)leaf->rows[first + y][k],                             \
       (Real)leaf->rows[first + z][k])

FN Intersection packet_primitive(global const BvhLeaf* leaf, int kind, int k, PacketRay r,
                                 const PacketBounds* bounds, Real t, int any_hit) {
    if (HAS(shape_sphere) && kind == geometry_sphere)
        return intersect_sphere(sub3(r.origin, CORNER(0, 0, 1, 2)), r.direction,
                                (Real)leaf->rows[3][k], t);
    if (HAS(shape_disk) && kind == geometry_disk)
        return intersect_disk(sub3(CORNER(0, 0, 1, 2), r.origin), r.direction, CORNER(3, 0, 1, 2),
                              CORNER(6, 0, 1, 2), t);
    vec3 a, b, c, o;
    if (bounds->one_axis) {
        int x = bounds->axis[0], y = bounds->axis[1], z = bounds->axis[2];
        o = rename_axes(r, r.origin);
        a = sub3(CORNER(0, x, y, z), o);
        b = sub3(CORNER(3, x, y, z), o);
        c = sub3(CORNER(6, x, y, z), o);
    } else {
        a = rename_axes(r, sub3(CORNER(0, 0, 1, 2), r.origin));
        b = rename_axes(r, sub3(CORNER(3, 0, 1, 2), r.origin));
        c = rename_axes(r, sub3(CORNER(6, 0, 1, 2), r.origin));
    }
    return triangle_hit(a, b, c, r.shear, t, any_hit, bounds->coherent);
}

/// Takes the hits of one leaf into `hit`; returns the rays that have one. Rays that go the same way
/// mostly miss together; of others there is nearly always one that hits, so that no branch pays.
FN Mask packet_leaf(global const BvhLeaf* leaf, int kind, PacketRay r, const PacketBounds* bounds,
                    Int excluded, Mask live, int any_hit, PacketHit* hit) {
    Mask found = lanesOf(0);
    for (int k = 0; k < BVH_WIDTH; k++) {
        int number = leaf->primitive[k];
        if (number < 0) break;
        Intersection i = packet_primitive(leaf, kind, k, r, bounds, hit->t, any_hit);
        if (bounds->coherent && !someLane(i.hit)) continue;
        Mask hits = i.hit & live & (excluded != number);
        if (any_hit) {
            found = found | hits;
        } else {
            Mask closer = hits & ((i.t < hit->t) | ((Int)number < hit->primitive));
            hit->t = sel(closer, i.t, hit->t);
            hit->b1 = sel(closer, i.b1, hit->b1);
            hit->b2 = sel(closer, i.b2, hit->b2);
            hit->primitive = sel(closer, (Int)number, hit->primitive);
        }
    }
    return found;
}

/// The rays of `bits`, one after the other, through the tree below `code`.
FN uint few_rays(global const BvhNode* nodes, global const BvhLeaf* leaves, int code,
                 const PacketLanes* lanes, Int excluded, uint bits, int any_hit, PacketHit* hit) {
    RealLanes t, b1, b2;
    IntLanes primitive, not_hit;
    t.lanes = hit->t, b1.lanes = hit->b1, b2.lanes = hit->b2;
    primitive.lanes = hit->primitive, not_hit.lanes = excluded;
    uint found = 0;
    RayWalk w;
    WalkStack stack;
    for (; bits; bits &= bits - 1) {
        int k = lowest_bit(bits);
        walk_start(&w, &stack, single_ray(lanes, k), t.at[k], not_hit.at[k]);
        w.b1 = b1.at[k], w.b2 = b2.at[k], w.primitive = primitive.at[k];
        walk_alone(&w, &stack, nodes, leaves, code, any_hit);
        found |= (uint)(w.primitive != NO_PRIMITIVE) << k;
        t.at[k] = w.t, b1.at[k] = w.b1, b2.at[k] = w.b2, primitive.at[k] = w.primitive;
    }
    hit->t = t.lanes, hit->b1 = b1.lanes, hit->b2 = b2.lanes;
    hit->primitive = primitive.lanes;
    return found;
}

/// The closest hits of the active rays of a packet, or with any_hit whether each of them hits.
FN PacketHit traverse_packet(global const BvhNode* nodes, global const BvhLeaf* leaves, int root,
                             PacketRay ray, Real t_max, Int excluded, Mask active, int any_hit) {
    PacketHit hit;
    hit.t = t_max, hit.b1 = R(0.), hit.b2 = R(0.), hit.primitive = (Int)NO_PRIMITIVE;
    PacketBounds bounds = packet_bounds(ray, active);
    PacketLanes lanes = packet_lanes(ray);
    int stack[BVH_STACK];
    uint stack_bits[BVH_STACK];
    float stack_entry[BVH_STACK];
    uint open = maskBits(active), bits = open; // open: still looking
    int top = 0, code = root;
    for (;;) {
        int next = 0;
        uint next_bits = 0;
        if (LANES <= FEW_RAYS || (int)popcount(bits) <= FEW_RAYS) {
            uint found = few_rays(nodes, leaves, code, &lanes, excluded, bits, any_hit, &hit);
            if (any_hit) open &= ~found;
        } else if (code < 0) {
            Mask found = packet_leaf(leaves + (~code >> 2), ~code & 3, ray, &bounds, excluded,
                                     lanesOf(bits), any_hit, &hit);
            if (any_hit) {
                hit.primitive = sel(found, (Int)0, hit.primitive);
                open &= ~maskBits(found);
            }
        } else {
            global const BvhNode* node = nodes + code;
            RealLanes entry[LANE_GROUPS];
            uint candidates =
                bounds.coherent ? packet_cull(node, &bounds, entry) : present_children(node, entry);
            Real limit = hit.t * R(HIT_WIDENING);
            float next_entry = 0.f;
            // The nearest child is next; the others wait in no particular order.
            for (; candidates; candidates &= candidates - 1) {
                int k = lowest_bit(candidates);
                uint child_bits = maskBits(packet_overlap(node, k, ray, &bounds, limit)) & bits;
                if (!child_bits) continue;
                int child = node->child[k];
                float e = entry[k / LANES].at[k % LANES];
                if (!next_bits) {
                    next = child, next_bits = child_bits, next_entry = e;
                    continue;
                }
                int nearer = e < next_entry;
                stack[top] = nearer ? next : child;
                stack_bits[top] = nearer ? next_bits : child_bits;
                stack_entry[top] = nearer ? next_entry : e;
                top++;
                next = nearer ? child : next;
                next_bits = nearer ? child_bits : next_bits;
                next_entry = nearer ? e : next_entry;
            }
        }
        while (!next_bits) {
            if (top == 0 || !open) return hit;
            top--;
            next = stack[top];
            next_bits = stack_bits[top] & open;
            if (!any_hit) next_bits &= maskBits((Real)stack_entry[top] <= hit.t * R(HIT_WIDENING));
        }
        code = next, bits = next_bits;
    }
}
