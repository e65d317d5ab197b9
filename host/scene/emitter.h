// Emitters that are no surfaces.
#pragma once

#include "host/scene/parameter.h"

#include <glm/vec3.hpp>
#include <variant>

namespace parhelion {

struct PointEmitter {
    glm::dvec3 position{0.0};
    Rgb intensity{1.0}; ///< W/sr
};

/// Full intensity inside `beam_width`, falling linearly in angle to zero at `cutoff_angle` (both
/// half angles, radians).
struct SpotEmitter {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0, 0, 1}; ///< unit, the axis of the cone
    double cutoff_angle = 0.349066;
    double beam_width = 0.261799;
    Rgb intensity{1.0}; ///< W/sr on the axis
};

struct DirectionalEmitter {
    glm::dvec3 direction{0, 0, 1}; ///< unit, the way the light travels
    Rgb irradiance{1.0};           ///< W/m^2 on a surface facing it
};

struct ConstantEmitter {
    Rgb radiance{1.0}; ///< W/(m^2 sr) from every direction
};

using Emitter = std::variant<PointEmitter, SpotEmitter, DirectionalEmitter, ConstantEmitter>;

} // namespace parhelion
