// Picking a row of the light table, for the point that it is to light: walking down the light tree.
#ifndef PARHELION_LIGHT_TABLE_H
#define PARHELION_LIGHT_TABLE_H

#include "device/lanes_memory.h"

typedef struct {
    Int row;
    Real pmf;      // with which the row was picked; 0: no light reaches the surface
    Real pmf_hint; // the same for a surface of any orientation, which light_pmf finds again
} LightPick;

/// The two nodes that a step of the walk chooses between.
typedef struct {
    LightNode left, right;
    LightImportance left_importance, right_importance;
    LightImportance sum; // 1 where both are dark
    Mask lit;            // some light reaches the surface
} LightPair;

FN LightPair light_pair(global const LightNodeRecord* nodes, Int first, vec3 p, vec3 n) {
    LightPair pair;
    pair.left = load_LightNode(nodes, first);
    pair.right = load_LightNode(nodes + 1, first);
    LightImportance left = light_importance(pair.left, p, n),
                    right = light_importance(pair.right, p, n);
    Real surface = left.to_surface + right.to_surface, point = left.to_point + right.to_point;
    pair.lit = surface > R(0.);
    pair.sum.to_surface = sel(pair.lit, surface, R(1.));
    pair.sum.to_point = sel(point > R(0.), point, R(1.));
    pair.left_importance = left;
    pair.right_importance = right;
    return pair;
}

/// First channel of results of the lights' groups, in the lanes whose bits are set.
FN Int light_group(global const int* groups, Int row, uint bits) {
    return gather_int(groups, sel(lanesOf(bits), row, (Int)0));
}

/// One random number x chooses at every step; y refills the digits it loses by that.
FN LightPick pick_light(global const LightNodeRecord* nodes, vec3 p, vec3 n, Mask wanted, Uint x,
                        Uint y) {
    LightPick pick;
    pick.row = (Int)0;
    pick.pmf = R(1.);
    pick.pmf_hint = R(1.);
    if (!HAS(light_tree)) return pick; // there is one light
    Int first = (Int)0;
    Real u = uniform01(x);
    Mask walking = wanted;
    while (someLane(walking)) {
        LightPair pair = light_pair(nodes, first, p, n);
        Real at = u * pair.sum.to_surface, left_end = pair.left_importance.to_surface;
        Mask left = (at < left_end) | (pair.right_importance.to_surface == R(0.));
        Real chosen = sel(left, left_end, pair.right_importance.to_surface);
        Real chosen_hint = sel(left, pair.left_importance.to_point, pair.right_importance.to_point);
        pick.pmf = sel(walking, pick.pmf * (chosen / pair.sum.to_surface), pick.pmf);
        pick.pmf_hint =
            sel(walking, pick.pmf_hint * (chosen_hint / pair.sum.to_point), pick.pmf_hint);
        Int child = sel(left, pair.left.child, pair.right.child);
        Mask leaf = child < 0;
        pick.row = sel(walking & leaf & pair.lit, ~child, pick.row);
        walking = walking & pair.lit & !leaf;
        first = sel(walking, child, first);
        y = y * 1664525u + 1013904223u;
        Real refill = pair.sum.to_surface * R(5.9604644775390625e-8) * uniform01(y);
        Real within = sel(left, at, at - left_end) + refill;
        u = minR(within / sel(pair.lit, chosen, R(1.)), R(0.99999994));
    }
    return pick;
}

/// The light with the probability of its pick.
FN Light light_picked_with(Light light, Real pmf) {
    if (HAS(light_tree)) light.pmf = pmf;
    return light;
}

/// The hint of pick_light for the given row and a surface at p.
FN Real light_pmf(global const LightNodeRecord* nodes, global const int* leaves, vec3 p, Int row,
                  Mask wanted) {
    Real pmf = R(1.);
    if (!HAS(light_tree)) return pmf;
    Int at = gather_int(leaves, row);
    Mask walking = wanted;
    vec3 unused = v3(R(0.), R(0.), R(1.));
    while (someLane(walking)) {
        Mask left = (at & 1) == 0;
        LightPair pair = light_pair(nodes, at & ~1, p, unused);
        Real chosen = sel(left, pair.left_importance.to_point, pair.right_importance.to_point);
        pmf = sel(walking, pmf * (chosen / pair.sum.to_point), pmf);
        Int parent = pair.left.parent;
        walking = walking & (parent >= 0);
        at = sel(walking, parent, at);
    }
    return pmf;
}

#endif
