// The lists of lobes of surfaces that are several materials at once.
#ifndef PARHELION_LOBES_H
#define PARHELION_LOBES_H

#include "device/scene_tables.h"

/// Walks the lists of the lanes, each an entry at a time. `entry` means nothing where not `inside`.
typedef struct {
    Mask inside;
    Int entry;
    Lobe lobe;
} LobeWalk;

FN LobeWalk first_lobe(SceneTables scene, Int code) {
    LobeWalk w;
    w.inside = IS_BLEND(code);
    w.entry = sel(w.inside, BLEND_NUMBER(code), (Int)0);
    w.lobe = load_Lobe(scene.lobes, w.entry);
    return w;
}

FN LobeWalk next_lobe(SceneTables scene, LobeWalk w) {
    w.inside = w.inside & (w.lobe.behind > 0);
    w.entry = sel(w.inside, w.entry + 1, w.entry);
    w.lobe = load_Lobe(scene.lobes, w.entry);
    return w;
}

/// Of a surface's lobes the one that its direction is drawn from.
typedef struct {
    Int entry; // of the list; -1: the surface is one material alone
    Int row;   // of the materials
    Real weight;
} ChosenLobe;

/// One of them by its weight for u in [0, 1): the last whose interval begins at u or before.
FN ChosenLobe chosen_lobe(SceneTables scene, Int code, Real u) {
    ChosenLobe c;
    c.entry = (Int)(-1);
    c.row = code;
    c.weight = R(1.);
    for (LobeWalk w = first_lobe(scene, code); someLane(w.inside); w = next_lobe(scene, w)) {
        Mask begun = w.inside & (w.lobe.below <= u);
        c.entry = sel(begun, w.entry, c.entry);
        c.row = sel(begun, w.lobe.material, c.row);
        c.weight = sel(begun, w.lobe.weight, c.weight);
    }
    return c;
}

#endif
