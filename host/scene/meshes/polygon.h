// Faces of more than three corners: which triangles cover them.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace parhelion {

/// Where two edges of a face cross there is a corner more: a weighted mean of four others.
struct CrossingCorner {
    std::array<std::uint32_t, 4> corners;
    std::array<double, 4> weights; ///< sum 1
};

/// Triangles over the corners of a face, counted from 0; from the number of corners on they mean
/// `crossings`, which refer to corners and to crossings before them.
struct PolygonTriangles {
    std::vector<glm::uvec3> triangles;
    std::vector<CrossingCorner> crossings;
    bool tangled = false; ///< crosses itself too often; the rest is empty
};

/// Covers the inside of a closed polygon of three corners or more, which need not be flat: inside
/// is what its outline, seen along its normal (Newell's: the mean of the corners' planes), goes
/// around an odd number of times. An outline that crosses itself in that view is also looked at
/// along the normal of the plane that fits its corners best. The triangles face as the polygon
/// does.
///
/// Where the fan around the first corner covers it, as for every convex face, the triangles are
/// that fan; so are those of a polygon without area. Corners must be finite.
PolygonTriangles triangulate(std::span<const glm::dvec3> corners);

} // namespace parhelion
