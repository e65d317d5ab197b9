// The angle of view of cameras, and of projectors.
#include "host/scene/camera.h"

#include <glm/trigonometric.hpp>

#include <cmath>

namespace parhelion {

double horizontal_fov(const Camera& camera, int width, int height) {
    double aspect = static_cast<double>(width) / height;
    FovAxis axis = camera.fov_axis;
    double half_tangent = 0.0;
    if (camera.focal_length_mm) {
        axis = FovAxis::diagonal;
        half_tangent = std::hypot(36.0, 24.0) / (2.0 * *camera.focal_length_mm);
    } else {
        half_tangent = std::tan(0.5 * glm::radians(camera.fov_degrees.value_or(90.0)));
    }
    if (axis == FovAxis::smaller) axis = aspect > 1.0 ? FovAxis::y : FovAxis::x;
    if (axis == FovAxis::larger) axis = aspect > 1.0 ? FovAxis::x : FovAxis::y;
    if (axis == FovAxis::y) half_tangent *= aspect;
    if (axis == FovAxis::diagonal) half_tangent /= std::sqrt(1.0 + 1.0 / (aspect * aspect));
    return 2.0 * std::atan(half_tangent);
}

} // namespace parhelion
