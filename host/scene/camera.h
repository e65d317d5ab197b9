// The camera.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>

namespace parhelion {

enum class FovAxis { x, y, diagonal, smaller, larger };

/// Pinhole, thin-lens or orthographic camera. Camera space: looks along +z, +y is up, +x is to the
/// LEFT of the image (Mitsuba's convention: to_world is a rotation and translation, in rare files
/// with a mirror, and image x runs along camera -x).
struct Camera {
    glm::dmat4 to_world{1.0};
    /// Rays are parallel to camera z. The film is 2 wide, from camera x = -1 to 1, its pixels
    /// square; to_world scales it, and its z axis alone is of unit length. No field of view, no
    /// aperture.
    bool orthographic = false;
    std::optional<double>
        fov_degrees; ///< full angle along fov_axis; absent when focal_length_mm is given
    std::optional<double>
        focal_length_mm; ///< of a 35 mm film (24 mm x 36 mm: full diagonal 43.27 mm)
    FovAxis fov_axis = FovAxis::x;
    double near_clip = 1e-2, far_clip = 1e4; ///< distances along the optical axis, world units
    glm::dvec2 principal_point_offset{0.0};  ///< in fractions of the film width and height
    double aperture_radius = 0.0;            ///< 0 for a pinhole
    double focus_distance = 1.0;
};

/// Full horizontal angle of view in radians, from whichever of angle and focal length the scene
/// gives.
double horizontal_fov(const Camera& camera, int width, int height);

} // namespace parhelion
