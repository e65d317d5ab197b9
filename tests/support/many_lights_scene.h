// A hall with many small lamps: as many as asked for, of every kind that has a place, in random
// places, orientations and strengths.
#pragma once

#include "host/numerics/every_kind_scene.h"
#include "host/numerics/measure.h"

namespace parhelion::test {

using namespace parhelion::numerics;

/// A floor and a wall under `count` lights; `mixed`: points, spots, spheres, disks and a faint sky
/// among the quads.
inline Scene many_lights_scene(int count, bool mixed) {
    Scene scene;
    scene.file = "made by the test";
    scene.materials.push_back({"", {}, DiffuseBsdf{Rgb(0.7, 0.6, 0.5)}});
    scene.shapes.push_back(shape_of(quad({-10, 0, -10}, {0, 0, 20}, {20, 0, 0}), 0, 0));
    scene.shapes.push_back(shape_of(quad({-10, 0, -10}, {20, 0, 0}, {0, 8, 0}), 0, 0));
    Random random(7);
    double size = 3 / std::sqrt(double(count));
    auto scaled = [&] { return glm::dvec3(random.sign() * random.between(0.2, 1) * size); };
    for (int k = 0; k < count; k++) {
        glm::dvec3 at(random.between(-9, 9), random.between(0.5, 5), random.between(-9, 9));
        Rgb radiance = Rgb(random.log_between(0.3, 30));
        auto axis = random.direction<F64>();
        glm::dvec3 normal(axis.x, axis.y, axis.z);
        glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8))) * scaled();
        glm::dvec3 v = glm::normalize(glm::cross(normal, u)) * scaled();
        switch (mixed ? k % 5 : 0) {
        case 0:
            scene.shapes.push_back(shape_of(quad(at, u, v), 0, no_material, radiance));
            break;
        case 1:
            scene.emitters.push_back(PointEmitter{at, radiance * size * size});
            break;
        case 2:
            scene.emitters.push_back(SpotEmitter{at, normal, 0.9, 0.5, radiance * size * size});
            break;
        case 3:
            scene.shapes.push_back(shape_of(Sphere{at, 0.3 * size}, 0, no_material, radiance));
            break;
        default:
            scene.shapes.push_back(shape_of(Disk{at, 0.5 * u, 0.5 * v}, 0, no_material, radiance));
        }
    }
    if (mixed) scene.emitters.push_back(ConstantEmitter{Rgb(0.01)});
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 0.9, -0.4, 0),
                                       glm::dvec4(0, -0.4, -0.9, 0), glm::dvec4(0, 6, 12, 1));
    scene.camera.fov_degrees = 60;
    scene.film.width = scene.film.crop_width = 32;
    scene.film.height = scene.film.crop_height = 24;
    scene.film.pixel_format = PixelFormat::rgb;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 3;
    scene.integrator.hide_emitters = true; // their edges would be most of the noise
    scene.sampler.samples_per_pixel = 64;
    return scene;
}

} // namespace parhelion::test
