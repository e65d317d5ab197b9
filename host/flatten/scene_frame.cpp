// The frame that the device sees a scene in.
#include "host/flatten/scene_frame.h"

#include "host/error.h"
#include "host/scene/shape_bounds.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace parhelion {
namespace {

constexpr int size_exponent = 10; // of the largest side, in units of the device

double scale_for(const glm::dvec3& extent, const std::string& file) {
    if (!std::isfinite(extent.x) || !std::isfinite(extent.y) || !std::isfinite(extent.z))
        throw InputError(fmt::format("{}: the shapes are so far apart that their distance is no "
                                     "number (accepted: up to {:.0e})",
                                     file, std::numeric_limits<double>::max()));
    double size = std::max({extent.x, extent.y, extent.z});
    if (size == 0.0) return 1.0;
    // The scale must be a number too, of which there are none for scenes smaller than that.
    constexpr int largest_exponent = 1000;
    return std::ldexp(1.0, std::min(size_exponent - std::ilogb(size), largest_exponent));
}

/// SceneFrame::start for a box about the camera.
double start_before(const ShapeBounds& box, const Camera& camera) {
    glm::dvec3 axis(camera.to_world[2]), extent = box.high - box.low;
    // The nearest corner: of each coordinate the end that adds least.
    glm::dvec3 along = glm::min(box.low * axis, box.high * axis) / glm::dot(axis, axis);
    double nearest = along.x + along.y + along.z, size = std::max({extent.x, extent.y, extent.z});
    constexpr double far = 64.0; // sizes
    return nearest > far * size ? std::max(nearest - size, camera.near_clip) : 0.0;
}

} // namespace

int SceneFrame::unit_exponent() const { return -std::ilogb(scale); }

Sphere SceneFrame::sphere(Sphere s) const {
    s.center = point(s.center);
    s.radius *= scale;
    return s;
}

Disk SceneFrame::disk(Disk d) const {
    d.center = point(d.center);
    d.edge_u *= scale;
    d.edge_v *= scale;
    return d;
}

Cylinder SceneFrame::cylinder(Cylinder c) const {
    c.base = point(c.base);
    c.axis *= scale;
    c.side *= scale;
    return c;
}

SceneFrame scene_frame(const Scene& scene) {
    SceneFrame frame;
    frame.camera = glm::dvec3(scene.camera.to_world[3]);
    ShapeBounds box;
    for (const Shape& shape : scene.shapes)
        box = join(box, bounds_of(shape.geometry, frame.camera));
    if (box.empty()) return frame;
    frame.shift = glm::clamp(glm::dvec3(0.0), box.low, box.high);
    // Seen from so far away that nobody can see it, the scene is a point: in a unit of its own size
    // the camera's place would be no number in single precision.
    constexpr double furthest = 0x1p-60;
    glm::dvec3 extent = box.high - box.low;
    if (extent != glm::dvec3(0.0)) extent = glm::max(extent, glm::abs(frame.shift) * furthest);
    frame.scale = scale_for(extent, scene.file);
    frame.start = start_before(box, scene.camera);
    return frame;
}

} // namespace parhelion
