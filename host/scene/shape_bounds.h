// Boxes around shapes.
#pragma once

#include "host/scene/shape.h"

#include <limits>

namespace parhelion {

/// Axis-aligned; empty as it begins.
struct ShapeBounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    bool empty() const { return low.x > high.x; }
};

ShapeBounds join(const ShapeBounds& a, const ShapeBounds& b);

/// The box around a shape, relative to `origin`: of a shape far from the world's origin a box about
/// a place nearby loses nothing. Of a mesh: around its triangles.
ShapeBounds bounds_of(const Geometry& geometry, const glm::dvec3& origin);

} // namespace parhelion
