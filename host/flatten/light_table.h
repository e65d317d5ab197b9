// The table of lights: every emitting primitive and every other emitter.
#pragma once

#include "host/flatten/device_scene.h"

namespace parhelion {

/// Fills lights, light_tree, sky_light and the primitives' light rows. Emitters without power
/// are left out.
void add_light_table(const Scene& scene, LightChoice choice, DeviceScene& out);

} // namespace parhelion
