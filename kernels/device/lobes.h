// The lists of lobes of surfaces that are several materials at once.
#ifndef PARHELION_LOBES_H
#define PARHELION_LOBES_H

#include "device/texture.h"

/// Multiplies a lobe's share by what textures tell of it there. Apart: looking up textures is much
/// to compile in each walk.
FN_APART void tell_share(Real* share, const SceneTables* scene, const Lobe* l,
                         const TexturePlace* place, const Mask* inside) {
    Int factor[LOBE_FACTORS] = {l->factor0, l->factor1, l->factor2, l->factor3};
    for (int k = 0; k < LOBE_FACTORS; k++) {
        Mask told = *inside & (factor[k] != 0), rest = factor[k] < 0;
        if (!someLane(told)) return;
        Int row = sel(rest, -factor[k], factor[k]) - 1;
        Real w = texture_number(*scene, row, *place, told);
        w = sel(w > R(1.), R(1.), w); // the luminance of a white, rounded
        *share = sel(told, *share * sel(rest, R(1.) - w, w), *share);
    }
}

/// As textures tell it there; `below` is that of the lobe before, and its share.
FN Lobe lobe_at(SceneTables scene, Int entry, Real below, TexturePlace place, Mask inside) {
    Lobe l = load_Lobe(scene.lobes, entry);
    if (!HAS(textured_blends)) return l;
    Real share = l.weight;
    tell_share(&share, &scene, &l, &place, &inside);
    l.weight = share;
    l.below = below;
    return l;
}

/// Walks the lists of the lanes, each an entry at a time. `entry` means nothing where not `inside`.
typedef struct {
    Mask inside;
    Int entry;
    Lobe lobe;
} LobeWalk;

FN LobeWalk first_lobe(SceneTables scene, Int code, TexturePlace place) {
    LobeWalk w;
    w.inside = IS_BLEND(code);
    w.entry = sel(w.inside, BLEND_NUMBER(code), (Int)0);
    w.lobe = lobe_at(scene, w.entry, R(0.), place, w.inside);
    return w;
}

FN LobeWalk next_lobe(SceneTables scene, LobeWalk w, TexturePlace place) {
    w.inside = w.inside & (w.lobe.behind > 0);
    w.entry = sel(w.inside, w.entry + 1, w.entry);
    w.lobe = lobe_at(scene, w.entry, w.lobe.below + w.lobe.weight, place, w.inside);
    return w;
}

/// Of a surface's lobes the one that its direction is drawn from.
typedef struct {
    Int entry; // of the list; -1: the surface is one material alone
    Int row;   // of the materials
    Real weight;
} ChosenLobe;

/// One of them by its weight for u in [0, 1): the last whose interval begins at u or before.
FN ChosenLobe chosen_lobe(SceneTables scene, Int code, TexturePlace place, Real u) {
    ChosenLobe c;
    c.entry = (Int)(-1);
    c.row = code;
    c.weight = R(1.);
    for (LobeWalk w = first_lobe(scene, code, place); someLane(w.inside);
         w = next_lobe(scene, w, place)) {
        Mask begun = w.inside & (w.lobe.below <= u);
        // Where it has no share it is not there, though rounding may leave it some of u.
        if (HAS(textured_blends)) begun = begun & !(w.lobe.weight <= R(0.));
        c.entry = sel(begun, w.entry, c.entry);
        c.row = sel(begun, w.lobe.material, c.row);
        c.weight = sel(begun, w.lobe.weight, c.weight);
    }
    return c;
}

#endif
