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

/// The closest hits of the active rays of a packet, or with any_hit whether each of them hits.
FN PacketHit traverse_packet(global const BvhNode* nodes, global const BvhLine* leaves, int root,
                             PacketRay ray, TreeSizes sizes, Real t_max, Int excluded, Mask active,
                             int any_hit) {
    PacketHit hit;
    hit.rank = any_hit ? t_max : rank_of_end(t_max);
    hit.t = t_max, hit.b1 = R(0.), hit.b2 = R(0.), hit.primitive = (Int)NO_PRIMITIVE;
    PacketBounds bounds = packet_bounds(ray, active, sizes);
    PacketLanes lanes = packet_lanes(ray);
    int stack[BVH_STACK];
    uint stack_bits[BVH_STACK];
    float stack_entry[BVH_STACK];
    uint open = maskBits(active), bits = open; // open: still looking
    int top = 0, code = root, few = bounds.coherent ? FEW_COHERENT_RAYS : FEW_RAYS;
    for (;;) {
        int next = 0;
        uint next_bits = 0;
        if (LANES == 1 || (int)popcount(bits) <= few) {
            uint found = few_rays(nodes, leaves, code, &lanes, excluded, bits, any_hit, &hit);
            if (any_hit) open &= ~found;
        } else if (code < 0) {
            Mask found = packet_leaf(leaf_at(leaves, code), LEAF_FORM(code), ray, &bounds, excluded,
                                     lanesOf(bits), any_hit, &hit);
            if (any_hit) {
                hit.primitive = sel(found, (Int)0, hit.primitive);
                open &= ~maskBits(found);
            }
        } else {
            global const BvhNode* node = IN_BUFFER(global const BvhNode, nodes, code);
            RealLanes entry[LANE_GROUPS];
            uint candidates =
                bounds.coherent ? packet_cull(node, &bounds, entry) : present_children(node, entry);
            Real limit = BOX_LIMIT(hit.rank, any_hit);
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
            if (!any_hit)
                next_bits &= maskBits((Real)stack_entry[top] <= hit.rank * R(HIT_WIDENING));
        }
        code = next, bits = next_bits;
    }
}

#endif
