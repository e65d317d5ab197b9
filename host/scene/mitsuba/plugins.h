// The readers of each kind of plugin: from parameters to the types of the scene.
//
// Every reader knows its plugins from one table and throws InputError for a plugin or a parameter
// that is not in it, with file and line.
#pragma once

#include "host/scene/mitsuba/document.h"

#include <optional>
#include <string>
#include <vector>

namespace parhelion::mitsuba {

using Notes = std::vector<std::string>;

/// What each side of a surface is made of (host/scene/material.h).
struct SurfaceMaterials {
    int front = no_material, back = no_material;
};

/// Adds to the scene's materials and blends.
SurfaceMaterials read_bsdf(const Document& document, const Object& object, Scene& scene,
                           Notes& notes);

class Properties;

/// `fov` along `fov_axis`, or `focal_length`.
void read_field_of_view(Properties& p, Camera& camera);

/// A rotation, translation, and one scale for all axes, or refused: what else would deform `what`.
void check_similarity(Properties& p, const glm::dmat4& to_world, const char* what);
/// Unit vectors that `to_world` turns the axes to; none of them 0.
glm::dmat3 turned_axes(Properties& p, const glm::dmat4& to_world);
/// Along the vector that is the parameter; refuses one of no length.
glm::dvec3 unit_direction(Properties& p, const char* name, const glm::dvec3& direction);

/// The sun and the sky by their formula; `sun` and `sky` are those of files older than 2.0.
Emitter read_sunsky(Properties& p);
Emitter read_sun(Properties& p);
Emitter read_sky(Properties& p);

/// One of the emitters that are no surfaces.
Emitter read_emitter(const Document& document, const Object& object, Notes& notes);

/// The radiance of an `area` emitter inside a shape.
Textured<Rgb> read_area_emitter(const Document& document, const Object& object, Notes& notes);

/// The geometry of a shape; its bsdf and emitter are left to the caller.
Geometry read_shape(const Document& document, const Object& object, Notes& notes);

/// The first of each inside a shape, or null; read_shape refuses a second one.
struct ShapeParts {
    const Object* bsdf = nullptr;
    const Object* emitter = nullptr;
};
ShapeParts shape_parts(const Document& document, const Object& object);

inline constexpr int default_samples = 4; ///< a pixel, as in Mitsuba

struct SensorParts {
    Camera camera;
    Film film;
    Sampler sampler;
};
SensorParts read_sensor(const Document& document, const Object& object, Notes& notes);
Film read_film(const Document& document, const Object& object, Notes& notes);
ReconstructionFilter read_filter(const Document& document, const Object& object, Notes& notes);
Sampler read_sampler(const Document& document, const Object& object, Notes& notes);

Integrator read_integrator(const Document& document, const Object& object, Notes& notes);

} // namespace parhelion::mitsuba
