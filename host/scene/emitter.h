// Emitters that are no surfaces.
#pragma once

#include "host/scene/parameter.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <variant>

namespace parhelion {

struct PointEmitter {
    glm::dvec3 position{0.0};
    Rgb intensity{1.0}; ///< W/sr
};

/// What a light without size shines through: a picture in a plane across the light's axis. What
/// travels along d passes it at (u, v) = 1/2 + (dot(d, across), dot(d, down)) / dot(d, axis); the
/// two are perpendicular to each other and the axis.
struct Slide {
    glm::dvec3 across{1, 0, 0}, down{0, 1, 0};
    TextureUse texture{};
};

/// Full intensity inside `beam_width`, falling linearly in angle to zero at `cutoff_angle` (both
/// half angles, radians).
struct SpotEmitter {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0, 0, 1}; ///< unit, the axis of the cone
    double cutoff_angle = 0.349066;
    double beam_width = 0.261799;
    Rgb intensity{1.0}; ///< W/sr on the axis
    Slide slide{};      ///< its texture, if it has one, tells what that is multiplied by
};

/// Lights what it sees through its slide, u and v from 0 to 1: every wall across its axis evenly,
/// but for the texture.
struct ProjectorEmitter {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0, 0, 1}; ///< unit, its axis
    Slide slide{{-1, 0, 0}, {0, -1, 0}, {}};
    Rgb irradiance{1.0}; ///< times pi W/m^2, on a wall at unit distance; a texture multiplies it
};

struct DirectionalEmitter {
    glm::dvec3 direction{0, 0, 1}; ///< unit, the way the light travels
    Rgb irradiance{1.0};           ///< W/m^2 on a surface facing it
};

struct ConstantEmitter {
    Rgb radiance{1.0}; ///< W/(m^2 sr) from every direction
};

/// An image around everything, at infinity: its first row lies at +y of its own frame, its last at
/// -y, between them columns run from -z over +x; texels have their values at the middle of their
/// columns and at their rows' angles, which are evenly spread from pole to pole.
struct EnvmapEmitter {
    TextureUse image;         ///< a bitmap
    glm::dmat3 to_world{1.0}; ///< orthonormal
    Rgb radiance{1.0};        ///< of a texel of 1
};

/// The sun and the clear sky about it, at infinity, in a frame of their own whose y is up. The sun
/// below the horizon shines no more, nor does its sky.
struct SunskyEmitter {
    double turbidity = 3.0;                  ///< of the air, 1 to 10
    Rgb albedo{0.3};                         ///< of the ground
    glm::dvec3 sun{0, 1, 0};                 ///< unit, towards it
    double half_aperture = 0.00467574;       ///< the angle under which the sun's radius is seen
    double sun_scale = 1.0, sky_scale = 1.0; ///< of what each sends; the sun's, whatever its disk
    glm::dmat3 to_world{1.0};                ///< orthonormal
    Rgb radiance{1.0};                       ///< what all of it is multiplied by
};

using Emitter = std::variant<PointEmitter, SpotEmitter, DirectionalEmitter, ConstantEmitter,
                             EnvmapEmitter, ProjectorEmitter, SunskyEmitter>;

/// Null for one that shines through nothing.
inline const Slide* slide_of(const Emitter& e) {
    const auto* const spot = std::get_if<SpotEmitter>(&e);
    const auto* const projector = std::get_if<ProjectorEmitter>(&e);
    const Slide* const slide = spot ? &spot->slide : projector ? &projector->slide : nullptr;
    return slide && slide->texture ? slide : nullptr;
}

/// Light from wherever nothing is.
inline bool is_sky(const Emitter& e) {
    return std::holds_alternative<ConstantEmitter>(e) || std::holds_alternative<EnvmapEmitter>(e) ||
           std::holds_alternative<SunskyEmitter>(e);
}

} // namespace parhelion
