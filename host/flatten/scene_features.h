// The one place that decides which features a scene's kernels have.
#pragma once

#include "host/flatten/device_scene.h"

#include <cstddef>

namespace parhelion {

/// Read off the finished records: of shapes, materials and lights, and off what integrator, sampler
/// and film ask for. Depends on kinds only, never on values such as positions or colours. All but
/// what follows from energy tables.
FeatureDecisions scene_features(const Scene& scene, const DeviceScene& records);

/// After energy tables are made, or not.
void decide_energy_compensation(const Scene& scene, DeviceScene& records);

/// Features that cost time but change no image where a scene does not need them: every kind of
/// material, emitter and shape, and what looks for vertex normals, back materials and so on.
FeatureSet neutral_features();

/// Edges from the camera after which nothing more is to be seen; INT_MAX without limit.
int longest_path(const Integrator& integrator);

/// How rays are best traced among so many primitives.
bool traced_in_streams(std::size_t primitives);

} // namespace parhelion
