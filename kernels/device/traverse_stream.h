// A stream of rays through the wide BVH: several walks take turns, a step each, so that one waits
// for memory while the others work.
//
// The answers are those of a packet, to the bit. Streams pay where rays go different ways through a
// tree that is larger than the caches.
#ifndef PARHELION_TRAVERSE_STREAM_H
#define PARHELION_TRAVERSE_STREAM_H

#include "device/state.h"
#include "device/traverse.h"

// Walks under way at once.
#if LANES == 1
#define STREAM_WALKS 1
#else
#define STREAM_WALKS 16
#endif

/// A run of rays in the path state (closest hit) or the shadow state (any hit).
typedef struct {
    global float* state;
    long stride;       // floats between two fields
    int next, end;     // entries that have not been taken
    PacketLanes lanes; // LANES of them made ready, from a multiple of LANES on
    int any_hit;
    TreeSizes sizes;
} RayStream;

FN StatePlace stream_place(const RayStream* s, int entry) {
    return state_place(s->state, s->stride, entry);
}

/// Starts a walk with the next ray; its entry is returned.
FN int stream_take(RayStream* s, int begin, RayWalk* w, WalkStack* stack) {
    int entry = s->next++, lane = (entry - begin) % LANES;
    StatePlace place = stream_place(s, entry);
    if (lane == 0)
        s->lanes =
            packet_lanes(packet_ray(ray_at_origin(place), ray_at_direction(place), s->sizes));
    walk_start(w, stack, single_ray(&s->lanes, lane), *state_word(place, ray_t),
               *(global const int*)state_word(place, ray_excluded), s->any_hit);
    return entry;
}

FN void stream_answer(const RayStream* s, int entry, const RayWalk* w) {
    int hit = w->primitive != NO_PRIMITIVE;
    StatePlace place = stream_place(s, entry);
    if (s->any_hit) {
        *(global int*)state_word(place, shadow_blocked) = hit;
        return;
    }
    *state_word(place, path_t) = w->t;
    *state_word(place, path_b1) = w->b1;
    *state_word(place, path_b2) = w->b2;
    *(global int*)state_word(place, path_primitive) = hit ? w->primitive : -1;
}

/// Fetches what a walk visits next ahead of its turn.
FN void stream_prefetch(global const BvhNode* nodes, global const BvhLine* leaves, int code) {
    global const char* p =
        code >= 0 ? (global const char*)(nodes + code) : (global const char*)leaf_at(leaves, code);
    PREFETCH(p);
    PREFETCH(p + 64);
    PREFETCH(p + 128);
    PREFETCH(p + 192);
    if (code < 0 && BVH_LEAF_FORM(code) == BVH_PATCH) return;
    PREFETCH(p + 256);
    PREFETCH(p + 320);
    PREFETCH(p + 384);
    if (code >= 0) return;
    PREFETCH(p + 448);
    PREFETCH(p + 512);
    PREFETCH(p + 576);
}

/// Walks under way, and lists of those that stand at a node and those that stand at a leaf.
typedef struct {
    RayWalk walk[STREAM_WALKS];
    WalkStack stack[STREAM_WALKS];
    int entry[STREAM_WALKS], code[STREAM_WALKS];
    uchar at_node[STREAM_WALKS + 1], at_leaf[STREAM_WALKS + 1];
} StreamWalks;

/// How long the lists are; not beside them, so that it stays in registers.
typedef struct {
    int node, leaf;
} StreamCounts;

/// Sends walk i to its next node or leaf; a walk that is over (WALK_ENDS) answers, and the next ray
/// takes its place.
FN StreamCounts stream_send(StreamWalks* s, StreamCounts counts, RayStream* rays, int begin, int i,
                            int next, int root, global const BvhNode* nodes,
                            global const BvhLine* leaves) {
    if (next == WALK_ENDS) {
        stream_answer(rays, s->entry[i], &s->walk[i]);
        if (rays->next == rays->end) return counts;
        s->entry[i] = stream_take(rays, begin, &s->walk[i], &s->stack[i]);
        next = root;
    }
    stream_prefetch(nodes, leaves, next);
    s->code[i] = next;
    s->at_node[counts.node] = s->at_leaf[counts.leaf] = (uchar)i;
    counts.node += next >= 0;
    counts.leaf += next < 0;
    return counts;
}

/// Traces the entries [begin, end) of a state; begin is aligned to LANES.
///
/// Each round moves all walks at nodes, then all at leaves, and each of these in two passes: the
/// first has no branch that depends on a ray, so the processor overlaps the walks; the second
/// decides from what the first has stored, so that a branch guessed wrongly costs little.
FN void traverse_stream(global const BvhNode* nodes, global const BvhLine* leaves, int root,
                        global float* state, long stride, int begin, int end, int any_hit,
                        TreeSizes sizes) {
    RayStream rays;
    rays.state = state, rays.stride = stride;
    rays.next = begin, rays.end = end, rays.any_hit = any_hit, rays.sizes = sizes;
    StreamWalks s;
    StreamCounts at = {0, 0};
    for (int i = 0; i < STREAM_WALKS && rays.next < end; i++) {
        s.entry[i] = stream_take(&rays, begin, &s.walk[i], &s.stack[i]);
        at = stream_send(&s, at, &rays, begin, i, root, root, nodes, leaves);
    }
    int next[STREAM_WALKS];
    LeafHits hits[STREAM_WALKS];
    while (at.node + at.leaf > 0) {
        // Writing the list of this round trails reading that of the one before.
        int count = at.node;
        for (int k = 0; k < count; k++) {
            int i = s.at_node[k];
            next[k] = walk_node(&s.walk[i], &s.stack[i],
                                IN_BUFFER(global const BvhNode, nodes, s.code[i]), any_hit);
        }
        at.node = 0;
        for (int k = 0; k < count; k++) {
            int i = s.at_node[k], code = next[k];
            if (code == WALK_ENDS) code = walk_pop(&s.walk[i], &s.stack[i], any_hit);
            at = stream_send(&s, at, &rays, begin, i, code, root, nodes, leaves);
        }
        count = at.leaf;
        for (int k = 0; k < count; k++) {
            int i = s.at_leaf[k], code = s.code[i];
            leaf_hits(&s.walk[i], leaf_at(leaves, code), BVH_LEAF_FORM(code), any_hit, &hits[k]);
        }
        at.leaf = 0;
        for (int k = 0; k < count; k++) {
            int i = s.at_leaf[k];
            int code = s.code[i];
            int over = walk_take(&s.walk[i], leaf_at(leaves, code), BVH_LEAF_FORM(code), &hits[k],
                                 any_hit);
            code = over ? WALK_ENDS : walk_pop(&s.walk[i], &s.stack[i], any_hit);
            at = stream_send(&s, at, &rays, begin, i, code, root, nodes, leaves);
        }
    }
}

#endif
