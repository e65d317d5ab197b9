// Boxes around shapes.
#include "host/scene/shape_bounds.h"

#include "host/parallel.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace parhelion {
namespace {

ShapeBounds bounds_of(const Mesh& mesh, const glm::dvec3& origin) {
    // Of triangles: a vertex that none uses is not there.
    auto grow = [&](ShapeBounds box, std::size_t triangle) {
        for (int k = 0; k < 3; k++) {
            const glm::dvec3& p = mesh.positions[mesh.triangles[triangle][k]];
            box = join(box, {p, p});
        }
        return box;
    };
    ShapeBounds box = parallel_sum(mesh.triangles.size(), ShapeBounds{}, grow, join);
    return {box.low - origin, box.high - origin};
}

ShapeBounds bounds_around(const glm::dvec3& centre, const glm::dvec3& reach) {
    return {centre - reach, centre + reach};
}

ShapeBounds bounds_of(const Sphere& s, const glm::dvec3& origin) {
    return bounds_around(s.center - origin, glm::dvec3(s.radius));
}

ShapeBounds bounds_of(const Disk& d, const glm::dvec3& origin) {
    return bounds_around(d.center - origin, glm::sqrt(d.edge_u * d.edge_u + d.edge_v * d.edge_v));
}

/// Of the circles at its ends.
ShapeBounds bounds_of(const Cylinder& c, const glm::dvec3& origin) {
    const glm::dvec3 unit = glm::normalize(c.axis);
    const glm::dvec3 reach =
        glm::length(c.side) * glm::sqrt(glm::max(glm::dvec3(1.0) - unit * unit, 0.0));
    const glm::dvec3 base = c.base - origin;
    return join(bounds_around(base, reach), bounds_around(base + c.axis, reach));
}

} // namespace

ShapeBounds join(const ShapeBounds& a, const ShapeBounds& b) {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

ShapeBounds bounds_of(const Geometry& geometry, const glm::dvec3& origin) {
    return std::visit([&](const auto& shape) { return bounds_of(shape, origin); }, geometry);
}

} // namespace parhelion
