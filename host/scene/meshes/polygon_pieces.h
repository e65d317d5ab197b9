// Polygons in the plane: cut at diagonals into pieces, and those into triangles.
#pragma once

#include "host/scene/meshes/polygon.h"

namespace parhelion {

/// What `triangulate` promises of a flat outline, by GLU's tessellator. That takes a time of the
/// number of corners times the number of edges abreast, so large outlines are cut first.
PolygonTriangles cover_with_triangles(std::span<const glm::dvec2> outline);

using Outline = std::vector<std::uint32_t>; ///< numbers of points, in order

/// Parts of at most about `largest` corners, divided by diagonals that lie inside and meet no other
/// edge; larger ones where no such diagonal is found.
std::vector<Outline> cut_at_diagonals(std::span<const glm::dvec2> points, std::size_t largest);

} // namespace parhelion
