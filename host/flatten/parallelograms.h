// Pairs of triangles that together are one parallelogram: a lamp of two triangles is one light.
#pragma once

#include "host/flatten/scene_frame.h"

#include <array>
#include <optional>
#include <vector>

namespace parhelion {

/// Of a triangle.
using Corners = std::array<glm::dvec3, 3>;

/// Those of a mesh's triangle on the device, before they are rounded; and as it has them, rounded
/// to single precision.
Corners corners_of(const Mesh& mesh, std::size_t triangle, const SceneFrame& frame);
Corners rounded(const Corners& corners);
/// The same from its own first corner, from differences in the scene: what is small for its place
/// keeps its shape.
Corners edges_of(const Mesh& mesh, std::size_t triangle, const SceneFrame& frame);
double triangle_area(const Corners& corners);

/// Corners a, b, c of a parallelogram whose fourth is b + c - a; it faces where cross(b - a, c - a)
/// points.
using Parallelogram = std::array<glm::dvec3, 3>;

/// Is a triangle so small for where the device has it that its corners, rounded to single
/// precision, would be off by more than 2^-12 of its longest side?
bool is_tiny(const Mesh& mesh, std::size_t triangle, const SceneFrame& frame);

/// What two triangles, each counter-clockwise seen from its front, make together: they share an
/// edge and their other corners lie where a parallelogram has them, but for the rounding of
/// coordinates to single precision.
std::optional<Parallelogram> parallelogram_of(const Corners& first, const Corners& second);

/// For each triangle of a mesh, as the device has it: does it make a parallelogram with the next
/// one (which then does not with its own next)? Smooth normals must agree which side is the front,
/// and neither may be tiny.
std::vector<bool> starts_parallelogram(const Mesh& mesh, const SceneFrame& frame);

} // namespace parhelion
