// The share of light that rough surfaces send on by single scattering, tabulated for the device.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/scene/scene.h"
#include "kernels/shared/types.h"

#include <vector>

namespace parhelion {

/// Tables of a rough material, each of `azimuths` rows of ENERGY_COSINES values: one of a
/// conductor, two of an interface (seen from outside, from inside), two of a rough coat (what it
/// sends on, what it lets through). One azimuth is enough for an isotropic material. `compensated`
/// or not: of a coat, which has them either way.
std::vector<float> energy_tables(const MaterialRecord& material, int azimuths,
                                 bool compensated = true);

/// Adds the tables of all materials that need them, equal ones once, and tells their records where
/// they are; none where the kernels' features say that nothing is scattered.
void add_energy_tables(const Scene& scene, DeviceScene& out);

/// Does the material ask for it?
bool wants_energy_compensation(const Bsdf& bsdf);

} // namespace parhelion
