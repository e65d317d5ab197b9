// The one place that decides which features a scene's kernels have.
#pragma once

#include "host/render/device_scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace parhelion {

/// Mask over enum Feature (kernels/shared/features.h), read off the finished records: of surfaces,
/// materials and lights (vertices parallel to primitives, or none where nothing reads them), and
/// off what integrator, sampler and film ask for. Depends on kinds only, never on values such as
/// positions or colours.
std::uint64_t scene_features(const Scene& scene, const DeviceScene& records);

/// Features that cost time but change no image where a scene does not need them: every kind of
/// material, emitter and shape, and what looks for vertex normals, back materials and so on.
std::uint64_t neutral_features();

/// How rays are best traced among so many primitives.
std::uint64_t traversal_features(std::size_t primitives);

} // namespace parhelion
