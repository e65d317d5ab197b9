// One ray's walk through the wide BVH, a step at a time: LANES children or primitives each; closest
// hit and any hit are one body.
//
// Boxes are widened and triangles are watertight, so no hit is lost; of two hits of the same rank
// the lower primitive number wins, so the answer does not depend on the order of the walk.
#ifndef PARHELION_TRAVERSE_H
#define PARHELION_TRAVERSE_H

#include "device/traverse_doubt.h"

// Nothing hit: a number above all others, so that of two hits at one distance the lower wins.
#define NO_PRIMITIVE 0x7fffffff

// A child code that is neither a node nor a leaf: the walk is over.
#define WALK_ENDS ((int)0x80000000)

// Entries of a walk's stack: the marker at its bottom, one child more than wait at once for any
// hit, and what a packed store writes beyond its end.
#define WALK_STACK (BVH_STACK + 2 * LANES)

typedef struct {
    TraversalRay ray;
    float t, b1, b2; // the closest hit so far, or the end of the ray
    float rank;      // of it (Intersection); all that ranks higher is left out
    int primitive;   // NO_PRIMITIVE: nothing
    int excluded;    // the primitive that the ray may not hit
    int top;         // entries on the walk's stack
} RayWalk;

/// Children that wait, and how far away each of them begins.
typedef struct {
    int child[WALK_STACK];
    float entry[WALK_STACK];
} WalkStack;

FN void walk_start(RayWalk* w, WalkStack* stack, TraversalRay ray, float t_max, int excluded,
                   int any_hit) {
    w->ray = ray;
    w->rank = any_hit ? t_max : t_max + t_max * BACK_DELAY; // rank_of_end
    w->t = t_max, w->b1 = 0.f, w->b2 = 0.f;
    w->primitive = NO_PRIMITIVE;
    w->excluded = excluded;
    w->top = 1;
    stack->child[0] = WALK_ENDS;
    stack->entry[0] = -INFINITY;
}

/// The next child that waits and is not beyond the hit.
FN int walk_pop(RayWalk* w, const WalkStack* stack, int any_hit) {
    do
        w->top--;
    while (!any_hit && stack->entry[w->top] > w->rank * (float)HIT_WIDENING);
    return stack->child[w->top];
}

FN void walk_push(RayWalk* w, WalkStack* stack, Int child, Real entry, uint bits, int any_hit) {
    store_packed_private_int(stack->child + w->top, child, bits);
    if (!any_hit) store_packed_private(stack->entry + w->top, entry, bits);
    w->top += popcount(bits);
}

FN BoxOverlap node_overlap(global const BvhNode* node, int group, const TraversalRay* ray,
                           float t_max) {
#define BOX_PLANE(a, side, row)                                                                    \
    fmaR(LOAD_REAL(node->bounds[row] + group * LANES), (Real)ray->inverse[a],                      \
         (Real)ray->side##_offset[a])
#define BOX_NEAR(a) BOX_PLANE(a, near, ray->near_row[a])
#define BOX_FAR(a) BOX_PLANE(a, far, ray->near_row[a] ^ 1)
    return box_overlap(BOX_NEAR(0), BOX_NEAR(1), BOX_NEAR(2), BOX_FAR(0), BOX_FAR(1), BOX_FAR(2),
                       (Real)t_max);
}

/// Of the lanes in `mask`, the one with the smallest value, up to its last 4 bits, and those bits
/// replaced by the lane's number. Values are not negative.
FN int smallest_lane_key(Mask mask, Real value) {
    return lowestLaneInt(sel(mask, (asInt(value) & ~(LANES - 1)) | LANE_INDEX, (Int)NO_PRIMITIVE));
}

/// Lets the children of a node that the ray meets wait, but for the nearest, which is returned
/// (WALK_ENDS: none is met). They wait in no particular order; for any hit all of them do. No
/// branch depends on the ray where one group is all: of several walks, none waits for another's
/// answer.
FN int walk_node(RayWalk* w, WalkStack* stack, global const BvhNode* node, int any_hit) {
    int next = WALK_ENDS;
    float next_entry = 0.f, limit = BOX_LIMIT(w->rank, any_hit);
    for (int group = 0; group < LANE_GROUPS; group++) {
        BoxOverlap box = node_overlap(node, group, &w->ray, limit);
        uint bits = maskBits(box.meets);
        global const int* child = node->child + group * LANES;
        if (any_hit) {
            walk_push(w, stack, LOAD_INT(child), box.entry, bits, any_hit);
            continue;
        }
        int key = smallest_lane_key(box.meets, box.entry), lane = key & (LANES - 1);
        walk_push(w, stack, LOAD_INT(child), box.entry, bits & ~(1u << lane), any_hit);
        int nearest = bits ? child[lane] : WALK_ENDS;
        float nearest_entry = as_float(key & ~(LANES - 1));
        if (next == WALK_ENDS) {
            next = nearest, next_entry = nearest_entry;
        } else if (nearest != WALK_ENDS) {
            int nearer = nearest_entry < next_entry;
            stack->child[w->top] = nearer ? next : nearest;
            stack->entry[w->top] = nearer ? next_entry : nearest_entry;
            w->top++;
            next = nearer ? nearest : next;
            next_entry = nearer ? nearest_entry : next_entry;
        }
    }
    return next;
}

/// Which primitives of a leaf the ray hits before its closest hit, and where.
typedef struct {
    uint bits;                // with the doubtful
    uint doubtful;            // walk_take settles them
    RealLanes t[LANE_GROUPS]; // of the sign of the determinant
    RealLanes b1[LANE_GROUPS], b2[LANE_GROUPS];
} LeafHits;

FN void leaf_hits(const RayWalk* w, global const BvhLine* leaf, int form, int any_hit,
                  LeafHits* hits) {
    PatchCorners corners;
    if (form == BVH_PATCH) patch_corners((global const BvhPatch*)leaf, &w->ray, &corners);
    hits->bits = hits->doubtful = 0;
    float size = leaf_size(form == BVH_PATCH ? ((global const BvhPatch*)leaf)->triangle
                                             : ((global const BvhLeaf*)leaf)->primitive);
    for (int group = 0; group < LANE_GROUPS; group++) {
        TriangleHit h = form == BVH_PATCH ? patch_triangles((global const BvhPatch*)leaf, &corners,
                                                            group, &w->ray, size, w->rank, any_hit)
                                          : leaf_group((global const BvhLeaf*)leaf, form, group,
                                                       &w->ray, size, w->rank, any_hit);
        hits->bits |= maskBits(h.hit | h.doubtful) << (group * LANES);
        hits->doubtful |= maskBits(h.doubtful) << (group * LANES);
        if (any_hit) continue;
        hits->t[group].lanes = flipSign(h.t, h.determinant);
        hits->b1[group].lanes = h.b1;
        hits->b2[group].lanes = h.b2;
    }
}

/// Takes the hits of a leaf; whether the walk is over: for any hit the first one ends it.
FN int walk_take(RayWalk* w, global const BvhLine* leaf, int form, const LeafHits* hits,
                 int any_hit) {
    for (uint bits = hits->bits; bits; bits &= bits - 1) {
        int k = lowest_bit(bits), number = leaf_number(leaf, form, k);
        if (number == w->excluded) continue;
        int group = k / LANES, lane = k % LANES;
        SingleHit hit = {0.f, 0.f, 0.f, 0.f};
        if (RARELY((hits->doubtful >> k) & 1)) {
            TraversalRay ray = w->ray; // so that the walk itself may stay in registers
            SingleHit settled;
            settle_single(leaf, form, k, &ray, w->rank, any_hit, &settled);
            if (settled.t < 0.f) continue;
            hit = settled;
        } else if (!any_hit) {
            float t = hits->t[group].at[lane];
            hit.t = hit.rank = t < 0.f ? -t : t;
            hit.b1 = hits->b1[group].at[lane], hit.b2 = hits->b2[group].at[lane];
            if (leaf_sees_back(form, &w->ray, t))
                hit.rank += leaf_back_delay(leaf, form, k, &w->ray, hit.t);
        }
        if (any_hit) {
            w->primitive = 0;
            return 1;
        }
        if (hit.rank < w->rank || (hit.rank == w->rank && number < w->primitive)) {
            w->rank = hit.rank, w->t = hit.t, w->b1 = hit.b1, w->b2 = hit.b2;
            w->primitive = number;
        }
    }
    return 0;
}

/// The whole walk of one ray through the tree below `code`.
FN void walk_alone(RayWalk* w, WalkStack* stack, global const BvhNode* nodes,
                   global const BvhLine* leaves, int code, int any_hit) {
    LeafHits hits;
    while (code != WALK_ENDS) {
        int next = WALK_ENDS;
        if (code >= 0) {
            next = walk_node(w, stack, IN_BUFFER(global const BvhNode, nodes, code), any_hit);
        } else {
            global const BvhLine* leaf = leaf_at(leaves, code);
            leaf_hits(w, leaf, BVH_LEAF_FORM(code), any_hit, &hits);
            if (walk_take(w, leaf, BVH_LEAF_FORM(code), &hits, any_hit)) return;
        }
        code = next == WALK_ENDS ? walk_pop(w, stack, any_hit) : next;
    }
}

#endif
