// Pairs of triangles that together are one parallelogram: a lamp of two triangles is one light.
#pragma once

#include "host/render/scene_frame.h"

#include <array>
#include <optional>
#include <vector>

namespace parhelion {

/// Corners a, b, c of a parallelogram whose fourth is b + c - a; it faces where cross(b - a, c - a)
/// points.
using Parallelogram = std::array<glm::dvec3, 3>;

/// What two triangles, each counter-clockwise seen from its front, make together: they share an
/// edge and their other corners lie where a parallelogram has them, but for the rounding of
/// coordinates to single precision.
std::optional<Parallelogram> parallelogram_of(const std::array<glm::dvec3, 3>& first,
                                              const std::array<glm::dvec3, 3>& second);

/// For each triangle of a mesh, as the device has it: does it make a parallelogram with the next
/// one (which then does not with its own next)? Smooth normals must agree which side is the front.
std::vector<bool> starts_parallelogram(const Mesh& mesh, const SceneFrame& frame);

} // namespace parhelion
