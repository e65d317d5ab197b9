// Coarse meshes of smooth shapes against the shapes: which shading normals come nearest is what the
// default goes by (the table in docs/accuracy.md).
#include "host/numerics/every_kind_scene.h"
#include "host/scene/mitsuba/transforms.h"
#include "tests/support/render_scene.h"
#include "tests/support/smooth_shapes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

struct Light {
    const char* name;
    Emitter emitter;
};

const Light lights[] = {
    {"sun", DirectionalEmitter{glm::normalize(glm::dvec3(-1, -0.7, -0.3)), Rgb(std::numbers::pi)}},
    {"sky", ConstantEmitter{Rgb(1)}}};

struct Shape3 {
    const char* name;
    SurfacePoint (*at)(double, double);
};

const Shape3 shapes[] = {
    {"sphere", sphere_point}, {"torus", torus_point}, {"ellipsoid", ellipsoid_point}};

Image image_of(const Shape3& shape, unsigned rows, const Light& light, ShadingNormals normals) {
    Scene scene;
    scene.file = "made by the test";
    scene.materials.push_back({"", {}, DiffuseBsdf{Rgb(0.8)}});
    scene.shapes = {numerics::shape_of(smooth_mesh(shape.at, rows), 0, no_material)};
    scene.emitters = {light.emitter};
    scene.camera.to_world = mitsuba::look_at({0, 2, 4}, {0, 0, 0}, {0, 1, 0}, {scene.file, 0});
    scene.camera.fov_degrees = 30;
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 64;
    scene.film.pixel_format = PixelFormat::rgba;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 4;
    scene.integrator.hide_emitters = true; // alpha tells where the shape is
    scene.integrator.shading_normals = normals;
    scene.sampler.samples_per_pixel = 64;
    return render_quietly(scene).image;
}

/// Root mean square of the difference, over the pixels that both cover.
double error_of(const Image& image, const Image& truth) {
    auto values = [](const Image& i, const char* name) { return find_channel(i, name)->values; };
    std::vector<float> a = values(image, "A"), b = values(truth, "A"), x = values(image, "G"),
                       y = values(truth, "G");
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < a.size(); i++)
        if (a[i] > 0.999f && b[i] > 0.999f) sum += std::pow(double{x[i]} - y[i], 2), count++;
    REQUIRE(count > 200);
    return std::sqrt(sum / count);
}

} // namespace

TEST_CASE("Smooth shapes: the default is as near to the true surface as raw normals, and nearer "
          "than soft ones",
          "[render]") {
    constexpr auto fallback = ShadingNormals::consistent; // the default
    CHECK(Integrator{}.shading_normals == fallback);
    for (const Shape3& shape : shapes)
        for (const Light& light : lights) {
            Image truth = image_of(shape, 300, light, ShadingNormals::raw);
            for (unsigned rows : {10u, 20u, 40u}) {
                double raw = error_of(image_of(shape, rows, light, ShadingNormals::raw), truth),
                       soft = error_of(image_of(shape, rows, light, ShadingNormals::soft), truth),
                       kept = error_of(image_of(shape, rows, light, fallback), truth);
                std::string figures =
                    fmt::format("{}, {}, {} x {}: raw {:.5f}, consistent {:.5f}, soft {:.5f}",
                                shape.name, light.name, rows, 2 * rows, raw, kept, soft);
                INFO(figures);
                if (std::getenv("PARHELION_FIGURES")) fmt::print("{}\n", figures);
                CHECK(kept <= 1.02 * raw);
                CHECK(kept < soft);
            }
        }
}
