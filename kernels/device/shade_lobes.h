// All lobes of a surface that is several materials at once, together: what a path draws its
// direction from one of them for, and what light is worth to it.
//
// Looping over all, and not just over the one that is drawn from, takes a sixth more time and from
// a quarter to a half of the squared error (a diffuse and a glossy lobe under small lights).
#ifndef PARHELION_SHADE_LOBES_H
#define PARHELION_SHADE_LOBES_H

#include "device/shade_material.h"

/// What a lobe is scaled by: its energy, and the share of light from or to wi (world) that counts
/// there.
FN vec3 lobe_scale(ShadeWork w, Shading s, SeenMaterial lobe, vec3 wi, Mask lanes) {
    vec3 scale = splat3(R(1.));
    if (HAS(energy_compensation))
        scale = compensate_energy(w.scene.energy_tables, lobe.material, lobe.wo, lanes);
    if (HAS(consistent_normals)) scale = scale3(scale, counted_share(s.sides, lobe.material, wi));
    return scale;
}

/// Weighted, of all lobes, `chosen` being that of the lobe that is drawn from, scaled; of other
/// lanes the chosen alone. wi: world.
FN BsdfEval eval_all_lobes(ShadeWork w, Shading s, BsdfEval chosen, vec3 wi, Mask lanes) {
    vec3 in_frame = to_local(s.frame, wi);
    BsdfEval sum;
    sum.f = scale3(chosen.f, s.lobe.weight);
    sum.pdf = chosen.pdf * s.lobe.weight;
    Int code = sel(lanes, s.code, (Int)(-1));
    for (LobeWalk l = first_lobe(w.scene, code, s.place); someLane(l.inside);
         l = next_lobe(w.scene, l, s.place)) {
        Mask other = l.inside & (l.entry != s.lobe.entry);
        Material m = material_of_row(w, s.place, l.lobe.material, other);
        Real side = side_to_viewer(m, s.wo.z * s.side);
        vec3 wo = v3(s.wo.x, s.wo.y, s.wo.z * s.side * side);
        SeenMaterial lobe = see_material(w.scene, m, s.place, l.lobe.material, wo, other);
        vec3 wi_above = v3(in_frame.x, in_frame.y, in_frame.z * side);
        BsdfEval e = eval_material(w.scene, lobe, wi_above, other);
        e.f = mul3(e.f, lobe_scale(w, s, lobe, wi, other));
        sum.f = sel3(other, add3(sum.f, scale3(e.f, l.lobe.weight)), sum.f);
        sum.pdf = sel(other, sum.pdf + e.pdf * l.lobe.weight, sum.pdf);
    }
    return sum;
}

/// The sample of the chosen lobe as one of all of them together; a direction that is the only one
/// of its lobe has no part in others. wi: b.wi in the world.
FN BsdfSample sample_of_all_lobes(ShadeWork w, Shading s, BsdfSample b, vec3 wi) {
    Mask spread = (b.pdf > R(0.)) & finiteR(b.pdf);
    vec3 alone = mul3(b.weight, lobe_scale(w, s, s.seen, wi, s.lanes));
    BsdfEval chosen;
    chosen.pdf = sel(spread, b.pdf, R(0.));
    chosen.f = scale3(alone, chosen.pdf);
    Mask several = spread & (s.lobe.entry >= 0);
    BsdfEval all = eval_all_lobes(w, s, chosen, wi, several);
    b.weight = sel3(several, scale3(all.f, R(1.) / sel(several, all.pdf, R(1.))), alone);
    b.pdf = sel(several, all.pdf, b.pdf);
    return b;
}

/// Reflectance of what is there: weighted, of all lobes but that of no surface at all, which a mask
/// has, as in Mitsuba 3.
FN vec3 all_lobes_reflectance(ShadeWork w, Shading s) {
    vec3 sum = splat3(R(0.));
    Real there = R(0.);
    for (LobeWalk l = first_lobe(w.scene, s.code, s.place); someLane(l.inside);
         l = next_lobe(w.scene, l, s.place)) {
        Material m = material_of_row(w, s.place, l.lobe.material, l.inside);
        Real weight = sel(l.inside & (m.kind != material_null), l.lobe.weight, R(0.));
        sum = add3(sum, scale3(material_reflectance(m), weight));
        there = there + weight;
    }
    Mask several = there > R(0.);
    vec3 mean = scale3(sum, R(1.) / sel(several, there, R(1.)));
    return sel3(several, mean, material_reflectance(s.material));
}

#endif
