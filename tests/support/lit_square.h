// A matte square that faces +z under one emitter, and what a camera above it sees.
#pragma once

#include "host/numerics/every_kind_scene.h"
#include "tests/support/host_render.h"

namespace parhelion::test {

inline Scene square_under(const Emitter& sky, double reflectance) {
    Scene scene;
    scene.file = "made by the test";
    scene.materials = {{"", {}, DiffuseBsdf{Rgb(reflectance)}}};
    scene.shapes.push_back(
        numerics::shape_of(numerics::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), 0, no_material));
    scene.emitters = {sky};
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 10, 1));
    scene.camera.fov_degrees = 1;
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 1;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 2;
    scene.sampler.samples_per_pixel = 4096;
    return scene;
}

inline double shown(const Scene& scene, const char* channel = "R") {
    Image image = host_render(scene, Precision::single_precision).image;
    return find_channel(image, channel)->values[0];
}

} // namespace parhelion::test
