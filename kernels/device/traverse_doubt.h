// Triangles of which rounding leaves open whether a ray has them ahead or behind (shared/
// intersect.h): once more from their corners, one triangle in all lanes.
//
// Functions of their own, which read the corners again: what is rarely needed takes no registers
// from what is always.
#ifndef PARHELION_TRAVERSE_DOUBT_H
#define PARHELION_TRAVERSE_DOUBT_H

#include "device/traverse_leaf.h"

/// The point in column k of three rows, in the order of `axis`.
FN vec3 column_along(const int* axis, global const float (*rows)[BVH_WIDTH], int k) {
    return v3((Real)rows[axis[0]][k], (Real)rows[axis[1]][k], (Real)rows[axis[2]][k]);
}

/// Triangle k of a leaf.
FN Corners triangle_corners(const int* axis, global const BvhLine* lines, int form, int k) {
    Corners v;
    if (form == BVH_PATCH) {
        global const BvhPatch* patch = (global const BvhPatch*)lines;
        int places = patch->triangle[k];
        v.a = column_along(axis, patch->corner, places & 15);
        v.b = column_along(axis, patch->corner, (places >> 4) & 15);
        v.c = column_along(axis, patch->corner, (places >> 8) & 15);
    } else {
        global const BvhLeaf* leaf = (global const BvhLeaf*)lines;
        v.a = column_along(axis, leaf->rows, k);
        v.b = column_along(axis, leaf->rows + 3, k);
        v.c = column_along(axis, leaf->rows + 6, k);
    }
    return v;
}

/// Of one ray; for any hit 0; below 0 where the triangle is not hit.
FN_APART float settled_distance(global const BvhLine* leaf, int form, int k,
                                const TraversalRay* ray, float t_max, int any_hit) {
    RayShear shear = single_shear(ray);
    Corners v = triangle_corners(ray->axis, leaf, form, k);
    RealLanes t;
    if (any_hit) {
        t.lanes = sel(triangle_occludes(v, shear, (Real)t_max), R(0.), R(-1.));
    } else {
        Intersection i = intersect_triangle(v, shear, (Real)t_max);
        t.lanes = sel(i.hit, i.t, R(-1.));
    }
    return t.at[0];
}

FN Corners packet_corners(PacketRay r, global const BvhLine* leaf, int form, int k) {
    const int xyz[3] = {0, 1, 2};
    Corners v = triangle_corners(xyz, leaf, form, k);
    v.a = rename_axes(r, v.a), v.b = rename_axes(r, v.b), v.c = rename_axes(r, v.c);
    return v;
}

/// Of a packet's rays in `lanes`: takes all their hits in a leaf; `lanes` becomes those that hit
/// anything.
FN_APART void settle_packet(Mask* lanes, global const BvhLine* leaf, int form, uint candidates,
                            const PacketRay* r, const Int* excluded, int any_hit, PacketHit* hit) {
    Mask found = lanesOf(0);
    for (; candidates; candidates &= candidates - 1) {
        int k = lowest_bit(candidates), number = leaf_number(leaf, form, k);
        Mask wanted = *lanes & (*excluded != number);
        Corners v = packet_corners(*r, leaf, form, k);
        if (any_hit) {
            found = found | (wanted & triangle_occludes(v, r->shear, hit->t));
            continue;
        }
        Intersection i = intersect_triangle(v, r->shear, hit->t);
        packet_closer(hit, i, number, i.hit & wanted);
        found = found | (i.hit & wanted);
    }
    *lanes = found;
}

#endif
