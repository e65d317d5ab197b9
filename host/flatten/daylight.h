// The sun and the sky by their formula, in double, and what the device gets of them.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/scene/emitter.h"

#include <array>

namespace parhelion {

/// What tables tell of one sun's place, air and ground: coefficients in the order of
/// DAYLIGHT_SKY_FIELDS (kernels/device/buffers.h), radiance last.
struct Daylight {
    bool sky = false, sun = false; ///< there, and shining
    std::array<std::array<double, DAYLIGHT_SKY_WORDS>, 3> colors{};
    Rgb sun_radiance{0.0};
    double edge = 0.0;         ///< square of the chord from the sun's middle to its edge
    glm::dvec3 direction{0.0}; ///< of the sun, in the sky's frame

    /// Of the sky above the horizon alone; w: a unit vector of the sky's frame.
    Rgb sky_radiance(const glm::dvec3& w) const;
    double solid_angle() const; ///< of the sun
};

/// Without the radiance that all of it is multiplied by.
Daylight daylight_of(const SunskyEmitter& emitter);

/// An image of the sky's brightness, for the table by which directions are chosen; none where there
/// is no sky.
TextureUse guide_of(const SunskyEmitter& emitter);

/// The words and the table of what the guide in row `texture` guides to.
Environment daylight_environment(const SunskyEmitter& emitter, const DeviceScene& records,
                                 int texture);

/// Which of the two shines. After the kinds of lights.
void decide_daylight(const DeviceScene& records, FeatureDecisions& out);

} // namespace parhelion
