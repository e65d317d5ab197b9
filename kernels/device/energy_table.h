// Looking up what a rough material's lobes are scaled by to keep the energy of single scattering,
// and what a rough coat lets through.
#ifndef PARHELION_ENERGY_TABLE_H
#define PARHELION_ENERGY_TABLE_H

#include "device/lanes_memory.h"

/// The share that stands at a place of the tables.
FN Real tabulated_share(global const float* tables, EnergyPlace place) {
    Real low = gather(tables, place.at), high = gather(tables + 1, place.at);
    Real share = low + place.along_cosine * (high - low);
    if (HAS(anisotropy)) {
        Real next_low = gather(tables + ENERGY_COSINES, place.at),
             next_high = gather(tables + ENERGY_COSINES + 1, place.at);
        Real next = next_low + place.along_cosine * (next_high - next_low);
        share = share + place.along_azimuth * (next - share);
    }
    return share;
}

FN vec3 compensate_energy(global const float* tables, Material m, vec3 wo, Mask wanted) {
    vec3 gain = splat3(R(1.));
    Mask compensated = wanted & (energy_table(m) >= 0);
    if (someLane(compensated)) {
        Real energy = tabulated_share(tables, energy_place(m, wo));
        gain = sel3(compensated, energy_gain(m, energy), gain);
    }
    return gain;
}

/// The material as the viewer sees it: what its coat lets through to wo, before it is scaled for
/// the energy that it keeps; from where light comes, nothing yet.
FN Material coat_seen_from(global const float* tables, Material m, vec3 wo, Mask wanted) {
    Mask coated = wanted & (m.kind == material_roughplastic);
    if (someLane(coated)) {
        EnergyPlace place = energy_place(m, wo);
        Real let_through = tabulated_share(tables + ENERGY_TABLE_SIZE, place);
        if (HAS(energy_compensation)) let_through = let_through * tabulated_share(tables, place);
        m.kb = sel(coated, let_through, m.kb);
        m.eg = sel(coated, R(0.), m.eg);
    }
    return m;
}

/// And where light comes from wi.
FN Material coat_lit_from(global const float* tables, Material m, vec3 wi, Mask coated) {
    Real let_through = tabulated_share(tables + ENERGY_TABLE_SIZE, energy_place(m, wi));
    m.eg = sel(coated, let_through, m.eg);
    return m;
}

#endif
