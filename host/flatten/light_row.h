// A row of the light table in the making: in double, before single precision rounds it.
#pragma once

#include "host/scene/scene.h"
#include "kernels/shared/features.h"
#include "kernels/shared/types.h"

namespace parhelion {

/// a, b, c, extra and radiance are what LIGHT_FIELDS and the emitter's own header say; lengths in
/// the device's units.
struct LightRow {
    EmitterKind kind = emitter_constant;
    glm::dvec3 a{0.0}, b{0.0}, c{0.0};
    Rgb radiance{0.0}; ///< the mean of that of a texture
    double extra = 0.0;
    double area = 0.0;     ///< of the emitting surface; 0: no surface
    double etendue = 0.0;  ///< power of a radiance of 1, in any common unit
    double peak = 1.0;     ///< of what an image makes of the radiance, the largest
    double mean = 1.0;     ///< of a sky's, over all directions
    double distance = 0.0; ///< of a light without size from the box around all shapes; 0 within
    int first_primitive = -1, primitive_count = 1; ///< that shine; -1: none does
    int group = 0;                                 ///< of the integrator's light groups
    int texture = -1;                              ///< that tells the radiance, a row; -1: none
    Rgb told{1.0};                                 ///< what its values are multiplied by
    glm::dvec3 across{0.0}; ///< of a light without size that shines through one: its frame
    double aspect = 1.0;    ///< (frame_place in kernels/shared/emitter_projector.h)
};

inline double brightness(const Rgb& c) { return c.r + c.g + c.b; }

/// Proportional to the power.
inline double power(const LightRow& row) { return row.etendue * brightness(row.radiance); }

} // namespace parhelion
