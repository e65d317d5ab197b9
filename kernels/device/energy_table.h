// Looking up what a rough material's lobes are scaled by to keep the energy of single scattering.
#ifndef PARHELION_ENERGY_TABLE_H
#define PARHELION_ENERGY_TABLE_H

#include "device/lanes_memory.h"

FN vec3 compensate_energy(global const float* tables, Material m, vec3 wo, Mask wanted) {
    vec3 gain = splat3(R(1.));
    Mask compensated = wanted & (energy_table(m) >= 0);
    if (someLane(compensated)) {
        EnergyPlace place = energy_place(m, wo);
        Real low = gather(tables, place.at), high = gather(tables + 1, place.at);
        Real energy = low + place.along_cosine * (high - low);
        if (HAS(anisotropy)) {
            Real next_low = gather(tables + ENERGY_COSINES, place.at),
                 next_high = gather(tables + ENERGY_COSINES + 1, place.at);
            Real next = next_low + place.along_cosine * (next_high - next_low);
            energy = energy + place.along_azimuth * (next - energy);
        }
        gain = sel3(compensated, energy_gain(m, energy), gain);
    }
    return gain;
}

#endif
