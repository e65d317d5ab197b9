// A sheet across the view: what is seen of it has a closed form.
#pragma once

#include "host/image/image.h"
#include "tests/support/two_of_every.h"

#include <utility>
#include <vector>

namespace parhelion::test {

/// Of 18 x 18 at z = 0, from z = 5, on a film of a few pixels; its texture coordinates are 0 to 1.
inline Scene sheet(int front, int back, std::vector<Material> materials) {
    Scene scene;
    scene.file = "made by the test";
    scene.materials = std::move(materials);
    Mesh mesh = quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0});
    for (const glm::dvec3& corner : mesh.positions)
        mesh.uvs.emplace_back((corner.x + 9) / 18, (corner.y + 9) / 18);
    scene.shapes = {shape_of(mesh, front, back)};
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 5, 1));
    scene.camera.fov_degrees = 2;
    scene.film.width = scene.film.crop_width = 8;
    scene.film.height = scene.film.crop_height = 8;
    scene.film.pixel_format = PixelFormat::rgba;
    scene.film.filter.kind = FilterKind::box;
    scene.sampler.samples_per_pixel = 64;
    scene.integrator.max_depth = 2;
    return scene;
}

inline double mean(const Image& image, const char* channel) {
    const auto& values = find_channel(image, channel)->values;
    double sum = 0;
    for (float v : values)
        sum += v;
    return sum / static_cast<double>(values.size());
}

} // namespace parhelion::test
