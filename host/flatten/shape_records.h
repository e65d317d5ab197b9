// Shapes of a scene as the device stores them: primitives, points and what they have beside.
#pragma once

#include "host/flatten/device_scene.h"

namespace parhelion {

/// Adds all shapes to the geometry of `out`, whose frame and materials are made; what meshes have
/// beside their points only where something reads it. Throws InputError where they are more than
/// the device's 32-bit indices reach.
void add_shapes(const Scene& scene, DeviceScene& out);

} // namespace parhelion
