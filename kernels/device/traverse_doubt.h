// Triangles of which rounding leaves open whether a ray passes inside, or has them ahead or behind
// (shared/intersect_edges.h, intersect_triangle.h): once more from their corners, one triangle in
// all lanes.
//
// Functions of their own, which read the corners again: what is rarely needed takes no registers
// from what is always. Whatever else decides about single hits, such as a mask that lets rays
// through, has its place here: it makes a hit doubtful, and settles it.
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

/// A hit of one ray: t is below 0 where there is none, and for any hit 0 where there is one.
typedef struct {
    float t, b1, b2, rank;
} SingleHit;

FN_APART void settle_single(global const BvhLine* leaf, int form, int k, const TraversalRay* ray,
                            float t_max, int any_hit, SingleHit* hit) {
    RayShear shear = single_shear(ray);
    Corners v = triangle_corners(ray->axis, leaf, form, k);
    RealLanes t, b1, b2, rank;
    if (any_hit) {
        t.lanes = sel(triangle_occludes(v, shear, (Real)t_max), R(0.), R(-1.));
        hit->t = t.at[0];
        return;
    }
    Intersection i = intersect_triangle(v, shear, (Real)t_max);
    t.lanes = sel(i.hit, i.t, R(-1.));
    b1.lanes = i.b1, b2.lanes = i.b2, rank.lanes = i.rank;
    hit->t = t.at[0], hit->b1 = b1.at[0], hit->b2 = b2.at[0], hit->rank = rank.at[0];
}

/// Whether the ray sees the back of what it hits (sees_back, certain_hit); `determinant`: of its
/// sign.
FN int leaf_sees_back(int form, const TraversalRay* ray, float determinant) {
    int triangle = form == BVH_PATCH || form == geometry_triangle;
    return (determinant < 0.f) != (triangle && ray->shear[2] < 0.f);
}

/// How much farther than its distance the back of primitive k of a leaf ranks, as in
/// intersect_triangle and ranked().
FN float leaf_back_delay(global const BvhLine* lines, int form, int k, const TraversalRay* ray,
                         float t) {
    if (form != BVH_PATCH && form != geometry_triangle) return t * BACK_DELAY;
    int z = ray->axis[2], a = k, b = k, c = k;
    global const float(*rows)[BVH_WIDTH] = ((global const BvhLeaf*)lines)->rows + z;
    int step = 3;
    if (form == BVH_PATCH) {
        global const BvhPatch* patch = (global const BvhPatch*)lines;
        int places = patch->triangle[k];
        a = places & 15, b = (places >> 4) & 15, c = (places >> 8) & 15;
        rows = patch->corner + z;
        step = 0;
    }
#define ONE_LARGER(x, y) ((x) > (y) ? (x) : (y))
#define ONE_SIZE(x) ((x) < 0.f ? -(x) : (x))
    float za = ONE_SIZE(rows[0][a] - ray->origin[z]), zb = ONE_SIZE(rows[step][b] - ray->origin[z]),
          zc = ONE_SIZE(rows[2 * step][c] - ray->origin[z]);
    return ONE_LARGER(za, ONE_LARGER(zb, zc)) * (ONE_SIZE(ray->shear[2]) * BACK_DELAY);
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
            found = found | (wanted & triangle_occludes(v, r->shear, hit->rank));
            continue;
        }
        Intersection i = intersect_triangle(v, r->shear, hit->rank);
        packet_closer(hit, i, number, i.hit & wanted);
        found = found | (i.hit & wanted);
    }
    *lanes = found;
}

#endif
