// Surfaces that are several materials at once: trees of blends, flattened to lists of lobes.
#pragma once

#include "host/flatten/device_scene.h"

#include <vector>

namespace parhelion {

/// After materials and shapes: adds a list of lobes for each blend of the scene, and names it in
/// the records of the shapes and primitives that are made of it.
void add_lobes(const Scene& scene, DeviceScene& out);

/// Of what a side is made of (kernels/shared/materials.h), in records: its list; a lobe of its own
/// for a single material; none for what absorbs.
std::vector<LobeRecord> lobes_of(const DeviceScene& records, int code);

} // namespace parhelion
