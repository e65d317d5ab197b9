// The frame that the device sees a scene in: a scene that is moved, or scaled by a power of two,
// has the same coordinates there, to the bit.
#pragma once

#include "host/scene/scene.h"

#include <glm/vec3.hpp>

namespace parhelion {

/// Centre and unit of the device's coordinates.
///
/// Centre: the point of the box around all shapes that is next to the camera; inside the box it is
/// the camera. A coordinate rounded to single precision is then off by 2^-24 of the distance from
/// the camera or less, wherever the scene is and however far it reaches: what is small and near the
/// camera keeps its shape beside a planet. The middle of the box would not do that.
///
/// Unit: a power of two, such that the largest side of the box is 2^10 to 2^11. Single precision
/// reaches from 2^-126 to 2^127 and products of four lengths are formed, so what is 2^-41 of the
/// scene still has an area squared, and what is 2^20 of it away (a lamp) a distance squared times
/// the square of the scene's size.
///
/// Rays from the camera begin there, or, where it is more than 64 times the box's largest side away
/// from the box along its axis, on a plane before the box: a ray from so far would not know what it
/// meets better than to 2^-24 of its way.
///
/// Everything is found from differences to the camera. Where the sum of a coordinate and what it is
/// moved by is exact, they are differences of other doubles but the same real number, and round to
/// the same bits; a power of two scales every one of them exactly.
struct SceneFrame {
    glm::dvec3 camera{0.0}; ///< where it is
    glm::dvec3 shift{0.0};  ///< from there to the centre
    double scale = 1.0;     ///< units of the device to one of the scene, a power of two
    double start = 0.0; ///< from the camera to where its rays begin, along its axis, the scene's
                        ///< units; 0: at the camera
    double radiance_unit = 1.0; ///< radiance of the scene that is 1 on the device (radiance_unit.h)

    /// World units.
    glm::dvec3 centre() const { return camera + shift; }
    /// One unit of the device, in the scene's.
    double unit() const { return 1.0 / scale; }
    int unit_exponent() const;

    /// Never -0, which a scene loses when it is moved.
    glm::dvec3 point(const glm::dvec3& p) const { return ((p - camera) - shift) * scale + 0.0; }
    Sphere sphere(Sphere s) const;
    Disk disk(Disk d) const;
    Cylinder cylinder(Cylinder c) const;
};

/// Throws InputError for a scene whose size is no number. Without shapes, or with all of them in
/// one point, the unit is the scene's own.
SceneFrame scene_frame(const Scene& scene);

} // namespace parhelion
