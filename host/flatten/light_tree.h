// The light tree: lights grouped by place, orientation and strength, so that a choice between many
// can look at the point to be lit.
#pragma once

#include "host/flatten/device_scene.h"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace parhelion {

/// What the tree knows of one light, or of a group.
struct LightBounds {
    glm::dvec3 low{0.0}, high{0.0}; ///< box around it
    glm::dvec3 axis{0, 0, 1};       ///< unit
    double cos_spread = 1.0;        ///< every light's axis is within this angle of `axis`, and
    double cos_emission = 1.0;      ///< shines within this angle of its own
    double intensity = 0.0;         ///< largest, radiance times device units squared; irradiance
                                    ///< of a plane that faces it where it is distant
    double power = 0.0;             ///< in the unit of the light table
    bool distant = false;           ///< without place
};

/// Bounds of two lights or groups, neither distant (cones as in Conty Estevez and Kulla 2018,
/// algorithm 1).
LightBounds merge(const LightBounds& a, const LightBounds& b);

/// Tree over two or more lights; empty for fewer. Splits by the surface area orientation heuristic
/// (Conty Estevez and Kulla 2018, section 4.4). Lights without place are chosen by power among each
/// other, and by their irradiance against all that have one.
LightTree build_light_tree(std::span<const LightBounds> lights, LightChoice choice);

} // namespace parhelion
