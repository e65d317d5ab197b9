// The table of lights: every emitting primitive and every other emitter, picked in proportion to
// power.
#pragma once

#include "host/render/device_scene.h"

#include <span>
#include <vector>

namespace parhelion {

/// Alias table for the given weights (not negative, sum > 0), as integers in units of 2^-32.
/// Vose 1991, "A linear algorithm for generating random numbers with a given distribution".
std::vector<LightAlias> make_alias_table(std::span<const double> weights);

/// Fills lights, light_aliases, constant_light and the primitives' light rows. Emitters without
/// power are left out.
void add_light_table(const Scene& scene, DeviceScene& out);

} // namespace parhelion
