// A packet of rays through the wide BVH together: a box or a primitive at a time against all lanes.
//
// The answers are those of traverse(), to the bit; it also takes over where few rays are left.
#ifndef PARHELION_TRAVERSE_PACKET_H
#define PARHELION_TRAVERSE_PACKET_H

#include "device/traverse.h"
#include "device/traverse_packet_leaf.h"

// Where no more than these are left of a packet, each goes on alone: a packet pays for rays that go
// the same way, which together miss most of what is in a leaf, or through a small tree.
#define FEW_RAYS 6
#define FEW_COHERENT_RAYS 2

/// Children that some ray of a coherent packet may meet, and where the first ray may enter them.
FN uint packet_cull(global const BvhNode* node, const PacketBounds* b, RealLanes* entry) {
    uint candidates = 0;
#define NODE_PLANE(a, far) LOAD_REAL(node->bounds[b->near_row[a] ^ far] + group * LANES)
    for (int group = 0; group < LANE_GROUPS; group++) {
        BoxOverlap box = bounds_overlap(b, v3(NODE_PLANE(0, 0), NODE_PLANE(1, 0), NODE_PLANE(2, 0)),
                                        v3(NODE_PLANE(0, 1), NODE_PLANE(1, 1), NODE_PLANE(2, 1)));
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

/// The rays of `bits`, one after the other, through the tree below `code`.
FN uint few_rays(global const BvhNode* nodes, global const BvhLine* leaves, int code,
                 const PacketLanes* lanes, Int excluded, uint bits, int any_hit, PacketHit* hit) {
    RealLanes t, b1, b2, rank;
    IntLanes primitive, not_hit;
    rank.lanes = hit->rank;
    t.lanes = hit->t, b1.lanes = hit->b1, b2.lanes = hit->b2;
    primitive.lanes = hit->primitive, not_hit.lanes = excluded;
    uint found = 0;
    RayWalk w;
    WalkStack stack;
    for (; bits; bits &= bits - 1) {
        int k = lowest_bit(bits);
        walk_start(&w, &stack, single_ray(lanes, k), t.at[k], not_hit.at[k], any_hit);
        w.rank = rank.at[k], w.b1 = b1.at[k], w.b2 = b2.at[k], w.primitive = primitive.at[k];
        walk_alone(&w, &stack, nodes, leaves, code, any_hit);
        found |= (uint)(w.primitive != NO_PRIMITIVE) << k;
        rank.at[k] = w.rank, t.at[k] = w.t, b1.at[k] = w.b1, b2.at[k] = w.b2,
        primitive.at[k] = w.primitive;
    }
    hit->rank = rank.lanes, hit->t = t.lanes, hit->b1 = b1.lanes, hit->b2 = b2.lanes;
    hit->primitive = primitive.lanes;
    return found;
}

/// A node or a leaf that rays of a packet are to visit, and where the first of them enters it.
typedef struct {
    int code;
    uint bits; // of the rays; none: there is nothing to visit
    float entry;
} PacketVisit;

typedef struct {
    int code[BVH_STACK];
    uint bits[BVH_STACK];
    float entry[BVH_STACK];
    int top;
} PacketStack;

FN void push_visit(PacketStack* stack, PacketVisit v) {
    stack->code[stack->top] = v.code;
    stack->bits[stack->top] = v.bits;
    stack->entry[stack->top] = v.entry;
    stack->top++;
}

/// The nearest of a node's children that the rays meet; the others wait in no particular order.
FN PacketVisit nearest_child(global const BvhNode* node, PacketRay ray, const PacketBounds* bounds,
                             Real limit, uint bits, PacketStack* waiting) {
    PacketVisit next = {0, 0, 0.f};
    RealLanes entry[LANE_GROUPS];
    uint candidates =
        bounds->coherent ? packet_cull(node, bounds, entry) : present_children(node, entry);
    for (; candidates; candidates &= candidates - 1) {
        int k = lowest_bit(candidates);
        PacketVisit child;
        child.bits = maskBits(packet_overlap(node, k, ray, bounds, limit)) & bits;
        if (!child.bits) continue;
        child.code = node->child[k];
        child.entry = entry[k / LANES].at[k % LANES];
        if (!next.bits) {
            next = child;
            continue;
        }
        int nearer = child.entry < next.entry;
        push_visit(waiting, nearer ? next : child);
        next = nearer ? child : next;
    }
    return next;
}

/// The last that waits, for the rays that are still open and may find something nearer there.
FN PacketVisit waiting_visit(PacketStack* stack, uint open, Real rank, int any_hit) {
    PacketVisit next = {0, 0, 0.f};
    while (!next.bits && stack->top > 0 && open) {
        stack->top--;
        next.code = stack->code[stack->top];
        next.bits = stack->bits[stack->top] & open;
        if (!any_hit)
            next.bits &= maskBits((Real)stack->entry[stack->top] <= rank * R(HIT_WIDENING));
    }
    return next;
}

/// The closest hits of the active rays of a packet, or with any_hit whether each of them hits.
FN PacketHit traverse_packet(global const BvhNode* nodes, global const BvhLine* leaves, int root,
                             PacketRay ray, TreeSizes sizes, Real t_max, Int excluded, Mask active,
                             int any_hit) {
    PacketHit hit;
    hit.rank = any_hit ? t_max : rank_of_end(t_max);
    hit.t = t_max, hit.b1 = R(0.), hit.b2 = R(0.), hit.primitive = (Int)NO_PRIMITIVE;
    PacketBounds bounds = packet_bounds(ray, active, sizes);
    PacketLanes lanes = packet_lanes(ray);
    PacketStack stack;
    stack.top = 0;
    uint open = maskBits(active), bits = open; // open: still looking
    int code = root, few = bounds.coherent ? FEW_COHERENT_RAYS : FEW_RAYS;
    for (;;) {
        PacketVisit next = {0, 0, 0.f};
        if (LANES == 1 || (int)popcount(bits) <= few) {
            uint found = few_rays(nodes, leaves, code, &lanes, excluded, bits, any_hit, &hit);
            if (any_hit) open &= ~found;
        } else if (code < 0) {
            Mask found = packet_leaf(leaf_at(leaves, code), BVH_LEAF_FORM(code), ray, &bounds,
                                     excluded, lanesOf(bits), any_hit, &hit);
            if (any_hit) {
                hit.primitive = sel(found, (Int)0, hit.primitive);
                open &= ~maskBits(found);
            }
        } else {
            next = nearest_child(IN_BUFFER(global const BvhNode, nodes, code), ray, &bounds,
                                 BOX_LIMIT(hit.rank, any_hit), bits, &stack);
        }
        if (!next.bits) next = waiting_visit(&stack, open, hit.rank, any_hit);
        if (!next.bits) return hit;
        code = next.code, bits = next.bits;
    }
}

#endif
