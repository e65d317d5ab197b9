// The share of light that rough surfaces send on by single scattering, tabulated for the device.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/scene/scene.h"
#include "kernels/shared/types.h"

#include <vector>

namespace parhelion {

/// Tables of a rough material: one of a conductor, two of an interface (seen from outside, from
/// inside), each of `azimuths` rows of ENERGY_COSINES values. One azimuth is enough for an
/// isotropic material.
std::vector<float> energy_tables(const MaterialRecord& material, int azimuths);

/// Adds the tables of all materials that are to be compensated, equal ones once, and tells their
/// records where they are; none where the kernels' features say that nothing is scattered.
void add_energy_tables(const Scene& scene, DeviceScene& out);

/// Does the material ask for it?
bool wants_energy_compensation(const Bsdf& bsdf);

} // namespace parhelion
