// The scene as its author wrote it: host types, double precision, names and places kept for
// messages. Nothing here knows about devices or kernels but for the list of materials.
#pragma once

#include "host/scene/camera.h"
#include "host/scene/emitter.h"
#include "host/scene/film.h"
#include "host/scene/integrator.h"
#include "host/scene/material.h"
#include "host/scene/sampler.h"
#include "host/scene/shape.h"

#include <string>
#include <vector>

namespace parhelion {

struct Scene {
    std::string file;
    std::vector<std::string> files; ///< that it was read from beside that one
    std::vector<Material> materials;
    std::vector<Blend> blends;
    std::vector<Shape> shapes;
    std::vector<Emitter> emitters;        ///< all but area emitters, which stand with their shapes
    std::vector<std::string> emitter_ids; ///< of those from the first on; "" for one without
    std::vector<std::string> sensors;     ///< names of those in the file, in its order
    Camera camera;                        ///< of the one that is used
    Film film;
    Integrator integrator;
    Sampler sampler;
    std::vector<std::string>
        notes; ///< what was mapped or defaulted and the user should be told, one line each
};

/// Its number. One without an id gets one by its place.
int add_material(Scene& scene, Material material);

/// What a side is made of that is `second` by `weight` in [0, 1], `first` by the rest, either of
/// which may be no_material: adds a blend of both where each has a share and they differ.
int add_blend(Scene& scene, Blend blend);

} // namespace parhelion
