// A packet of rays through the wide BVH together: a box or a primitive at a time against all lanes.
//
// The answers are those of traverse(), to the bit; it also takes over where few rays are left.

#include "device/traverse.h"

// Where no more than these are left of a packet, each goes on alone: a packet pays for rays that go
// the same way, or through a small tree.
#define FEW_RAYS 4

typedef struct {
    Real t, b1, b2;
    Int primitive; // -1: nothing
} PacketHit;

/// Bounds of a packet's origins and inverse directions; `coherent` if all rays meet the same planes
/// of every box first.
typedef struct {
    int coherent;
    int near_row[3], far_row[3];
    float near_origin[3], far_origin[3], near_inverse[3], far_inverse[3];
} PacketBounds;

FN PacketBounds packet_bounds(PacketRay r, Mask active) {
    PacketBounds b;
    b.coherent = 1;
    uint all = maskBits(active);
#define BOUND_AXIS(a, axis)                                                                        \
    {                                                                                              \
        uint negative = maskBits(r.negative_##axis & active);                                      \
        float low = lowestLane(sel(active, r.inverse.axis, (Real)INFINITY));                       \
        float high = highestLane(sel(active, r.inverse.axis, (Real)-INFINITY));                    \
        float first = lowestLane(sel(active, r.origin.axis, (Real)INFINITY));                      \
        float last = highestLane(sel(active, r.origin.axis, (Real)-INFINITY));                     \
        int down = negative != 0;                                                                  \
        b.coherent &= negative == 0 || negative == all;                                            \
        b.near_row[a] = 2 * a + down;                                                              \
        b.far_row[a] = 2 * a + 1 - down;                                                           \
        b.near_inverse[a] = down ? high : low;                                                     \
        b.far_inverse[a] = down ? low : high;                                                      \
        b.near_origin[a] = down ? first : last;                                                    \
        b.far_origin[a] = down ? last : first;                                                     \
    }
    BOUND_AXIS(0, x)
    BOUND_AXIS(1, y)
    BOUND_AXIS(2, z)
    return b;
}

/// Children that some ray of a coherent packet may meet: no ray's way through a box begins before
/// or ends after that of the bounds.
FN uint packet_cull(global const BvhNode* node, const PacketBounds* b) {
    uint candidates = 0;
#define CULL_ROW(side, a)                                                                          \
    ((LOAD_REAL(node->bounds[b->side##_row[a]] + group * LANES) - (Real)b->side##_origin[a]) *     \
     (Real)b->side##_inverse[a])
    for (int group = 0; group < LANE_GROUPS; group++)
        candidates |= maskBits(box_overlap(CULL_ROW(near, 0), CULL_ROW(near, 1), CULL_ROW(near, 2),
                                           CULL_ROW(far, 0), CULL_ROW(far, 1), CULL_ROW(far, 2),
                                           (Real)INFINITY))
                      << (group * LANES);
    return candidates;
}

/// Children that are there at all.
FN uint present_children(global const BvhNode* node) {
    uint present = 0;
    for (int group = 0; group < LANE_GROUPS; group++)
        present |= maskBits(LOAD_REAL(node->bounds[0] + group * LANES) < (Real)INFINITY)
                   << (group * LANES);
    return present;
}

/// Which rays meet child k before t; `entry` where they do.
FN Mask packet_overlap(global const BvhNode* node, int k, PacketRay r, Real t, Real* entry) {
#define CHILD_PLANE(row, axis) (((Real)node->bounds[row][k] - r.origin.axis) * r.inverse.axis)
    Real x0 = CHILD_PLANE(0, x), x1 = CHILD_PLANE(1, x);
    Real y0 = CHILD_PLANE(2, y), y1 = CHILD_PLANE(3, y);
    Real z0 = CHILD_PLANE(4, z), z1 = CHILD_PLANE(5, z);
    Real nx = sel(r.negative_x, x1, x0), fx = sel(r.negative_x, x0, x1);
    Real ny = sel(r.negative_y, y1, y0), fy = sel(r.negative_y, y0, y1);
    Real nz = sel(r.negative_z, z1, z0), fz = sel(r.negative_z, z0, z1);
    *entry = maxR(nx, maxR(ny, maxR(nz, R(0.))));
    return box_overlap(nx, ny, nz, fx, fy, fz, t);
}

#define CORNER(k, first)                                                                           \
    v3((Real)leaf->rows[first][k], (Real)leaf->rows[first + 1][k], (Real)leaf->rows[first + 2][k])

FN Intersection packet_primitive(global const BvhLeaf* leaf, int kind, int k, PacketRay r, Real t) {
    if (HAS(shape_sphere) && kind == geometry_sphere)
        return intersect_sphere(sub3(r.origin, CORNER(k, 0)), r.direction, (Real)leaf->rows[3][k],
                                t);
    if (HAS(shape_disk) && kind == geometry_disk)
        return intersect_disk(sub3(CORNER(k, 0), r.origin), r.direction, CORNER(k, 3), CORNER(k, 6),
                              t);
    return intersect_triangle(rename_axes(r, sub3(CORNER(k, 0), r.origin)),
                              rename_axes(r, sub3(CORNER(k, 3), r.origin)),
                              rename_axes(r, sub3(CORNER(k, 6), r.origin)), r.shear, t);
}

/// Takes the hits of one leaf into `hit`; returns the rays that have one.
FN Mask packet_leaf(global const BvhLeaf* leaf, int kind, PacketRay r, Int excluded, Mask live,
                    int any_hit, PacketHit* hit) {
    Mask found = lanesOf(0);
    for (int k = 0; k < BVH_WIDTH; k++) {
        int number = leaf->primitive[k];
        if (number < 0) break;
        Intersection i = packet_primitive(leaf, kind, k, r, hit->t);
        Mask hits = i.hit & live & (excluded != number);
        if (!someLane(hits)) continue;
        found = found | hits;
        if (any_hit) {
            live = live & !found;
            if (!someLane(live)) break;
            continue;
        }
        Mask closer =
            hits & ((i.t < hit->t) |
                    ((i.t == hit->t) & ((hit->primitive < 0) | ((Int)number < hit->primitive))));
        hit->t = sel(closer, i.t, hit->t);
        hit->b1 = sel(closer, i.b1, hit->b1);
        hit->b2 = sel(closer, i.b2, hit->b2);
        hit->primitive = sel(closer, (Int)number, hit->primitive);
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
    while (bits) {
        int k = lowest_bit(bits);
        bits &= bits - 1;
        TraversalRay ray = single_ray(lanes, k);
        RayHit h = traverse(nodes, leaves, code, &ray, t.at[k], not_hit.at[k], any_hit);
        if (h.primitive < 0) continue;
        found |= 1u << k;
        if (h.t < t.at[k] || primitive.at[k] < 0 || h.primitive < primitive.at[k]) {
            t.at[k] = h.t, b1.at[k] = h.b1, b2.at[k] = h.b2;
            primitive.at[k] = h.primitive;
        }
    }
    hit->t = t.lanes, hit->b1 = b1.lanes, hit->b2 = b2.lanes;
    hit->primitive = primitive.lanes;
    return found;
}

/// As traverse(), for the active rays of a packet.
FN PacketHit traverse_packet(global const BvhNode* nodes, global const BvhLeaf* leaves, int root,
                             PacketRay ray, Real t_max, Int excluded, Mask active, int any_hit) {
    PacketHit hit;
    hit.t = t_max, hit.b1 = R(0.), hit.b2 = R(0.), hit.primitive = (Int)(-1);
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
            Mask found = packet_leaf(leaves + (~code >> 2), ~code & 3, ray, excluded, lanesOf(bits),
                                     any_hit, &hit);
            if (any_hit) {
                hit.primitive = sel(found, (Int)0, hit.primitive);
                open &= ~maskBits(found);
            }
        } else {
            global const BvhNode* node = nodes + code;
            Mask live = lanesOf(bits);
            uint candidates = bounds.coherent ? packet_cull(node, &bounds) : present_children(node);
            float next_entry = 0.f;
            // The nearest child is next; the others wait in no particular order.
            while (candidates) {
                int k = lowest_bit(candidates);
                candidates &= candidates - 1;
                Real entry;
                Mask meets = packet_overlap(node, k, ray, hit.t, &entry) & live;
                uint child_bits = maskBits(meets);
                if (!child_bits) continue;
                int child = node->child[k];
                float e = any_hit ? 0.f : lowestLane(sel(meets, entry, (Real)INFINITY));
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
            if (!any_hit) next_bits &= maskBits((Real)stack_entry[top] <= hit.t * R(BOX_WIDENING));
        }
        code = next, bits = next_bits;
    }
}
