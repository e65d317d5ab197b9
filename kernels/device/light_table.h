// Picking a row of the light table, for the point that it is to light: walking down the light tree.

typedef struct {
    Int row;
    Real pmf;      // with which the row was picked; 0: no light reaches the surface
    Real pmf_hint; // the same for a surface of any orientation, which light_pmf finds again
} LightPick;

/// The two nodes that a step of the walk chooses between.
typedef struct {
    LightNode left, right;
    Real left_share, right_share;           // of the importance to the surface, 0 if both are dark
    Real left_share_hint, right_share_hint; // of the importance to the point
} LightPair;

FN LightPair light_pair(global const LightNodeRecord* nodes, Int first, vec3 p, vec3 n) {
    LightPair pair;
    pair.left = load_LightNode(nodes, first);
    pair.right = load_LightNode(nodes, first + 1);
    LightImportance left = light_importance(pair.left, p, n),
                    right = light_importance(pair.right, p, n);
    Real sum = left.to_surface + right.to_surface, sum_hint = left.to_point + right.to_point;
    Real scale = R(1.) / sel(sum > R(0.), sum, R(1.));
    Real scale_hint = R(1.) / sel(sum_hint > R(0.), sum_hint, R(1.));
    pair.left_share = left.to_surface * scale;
    pair.right_share = right.to_surface * scale;
    pair.left_share_hint = left.to_point * scale_hint;
    pair.right_share_hint = right.to_point * scale_hint;
    return pair;
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
        Mask lit = (pair.left_share > R(0.)) | (pair.right_share > R(0.));
        Mask left = (u < pair.left_share) | (pair.right_share == R(0.));
        Real share = sel(left, pair.left_share, pair.right_share);
        Real share_hint = sel(left, pair.left_share_hint, pair.right_share_hint);
        pick.pmf = sel(walking, pick.pmf * share, pick.pmf);
        pick.pmf_hint = sel(walking, pick.pmf_hint * share_hint, pick.pmf_hint);
        Int child = sel(left, pair.left.child, pair.right.child);
        Mask leaf = child < 0;
        pick.row = sel(walking & leaf & lit, ~child, pick.row);
        walking = walking & lit & !leaf;
        first = sel(walking, child, first);
        y = y * 1664525u + 1013904223u;
        Real within = sel(left, u, u - pair.left_share) + uniform01(y) * R(5.9604644775390625e-8);
        u = minR(within / sel(share > R(0.), share, R(1.)), R(0.99999994));
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
    Int at = asInt(gather((global const float*)leaves, row));
    Mask walking = wanted;
    vec3 unused = v3(R(0.), R(0.), R(1.));
    while (someLane(walking)) {
        Mask left = (at & 1) == 0;
        LightPair pair = light_pair(nodes, at & ~1, p, unused);
        Real share = sel(left, pair.left_share_hint, pair.right_share_hint);
        pmf = sel(walking, pmf * share, pmf);
        Int parent = pair.left.parent;
        walking = walking & (parent >= 0);
        at = sel(walking, parent, at);
    }
    return pmf;
}
