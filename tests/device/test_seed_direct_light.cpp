// Direct light on the device with values known exactly: two point lights over a plane, one of them
// blocked by a triangle; and the normals view of the bunny against the host's own hits.
#include "host/flatten/camera_record.h"
#include "host/render/device_render.h"
#include "host/scene/load.h"
#include "tests/support/single_primitives.h"
#include "tests/support/traversal.h"

#include "host/numerics/shapes.h"
#include "tests/support/skip.h"

#include <glm/geometric.hpp>

#include <filesystem>
#include <numbers>

using namespace parhelion;
using namespace parhelion::test;

namespace {

constexpr int samples = 16384;

Shape triangle_shape(std::vector<glm::dvec3> corners, int material) {
    Shape shape;
    Mesh mesh;
    mesh.positions = std::move(corners);
    for (unsigned i = 0; i + 2 < mesh.positions.size(); i += 3)
        mesh.triangles.push_back({i, i + 1, i + 2});
    shape.geometry = mesh;
    shape.material_front = shape.material_back = material;
    return shape;
}

/// Looks straight down from (0, 0, 4) with up = +y; 1 x 1 pixels of 1/64 a side, so that what is
/// seen is the origin.
Scene plane_with_lights(bool blocker) {
    Scene scene;
    scene.file = "made by the test";
    scene.materials.push_back({"grey", {}, DiffuseBsdf{Rgb(0.5, 0.25, 1.0)}});
    scene.shapes.push_back(triangle_shape({{-9, -9, 0}, {27, -9, 0}, {-9, 27, 0}}, 0));
    // Beside the camera's line of sight, across the way to the light at (2, 0, 2).
    if (blocker) scene.shapes.push_back(triangle_shape({{1, -1, .5}, {1, 1, .5}, {1, 0, 2}}, 0));
    scene.emitters.push_back(PointEmitter{{2, 0, 2}, Rgb(40, 20, 10)});
    scene.emitters.push_back(PointEmitter{{0, -3, 4}, Rgb(100, 50, 25)});
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 4, 1));
    scene.camera.fov_degrees = 1e-3;
    scene.film.width = scene.film.height = scene.film.crop_width = scene.film.crop_height = 1;
    scene.film.pixel_format = PixelFormat::rgb;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 2;
    scene.sampler.samples_per_pixel = samples;
    return scene;
}

double channel(const RenderResult& result, const char* name) {
    const Channel* c = find_channel(result.image, name);
    if (!c) throw std::runtime_error("no such channel");
    return c->values.at(0);
}

/// Radiance of the plane at the origin: sum of reflectance/pi * I * cos / d^2.
constexpr double light_a = 2 / std::numbers::sqrt2 / 2 / 8, light_b = 0.8 / 25;

} // namespace

TEST_CASE("Seed item f: direct light of two point lights with shadow rays, exact values",
          "[device][seed]") {
    RenderDevice device(choose_device(""));
    Progress quiet(Progress::Mode::quiet);
    const double reflectance[] = {0.5, 0.25, 1.0}, power_a[] = {40, 20, 10},
                 power_b[] = {100, 50, 25};
    const char* names[] = {"R", "G", "B"};
    for (bool blocker : {false, true}) {
        RenderResult result = render(plane_with_lights(blocker), device, {}, quiet);
        CHECK(result.report.shadow_rays == samples);
        for (int k = 0; k < 3; k++) {
            double a = reflectance[k] / M_PI * power_a[k] * light_a,
                   b = reflectance[k] / M_PI * power_b[k] * light_b;
            double found = channel(result, names[k]);
            CAPTURE(blocker, names[k], a, b);
            // A light is picked in proportion to its power: the estimate has the variance of one
            // coin a sample.
            double p = 40. / 140, arriving = blocker ? 0 : a;
            double sigma = std::sqrt(p * (1 - p) / samples) * std::fabs(arriving / p - b / (1 - p));
            CHECK(std::fabs(found - (arriving + b)) < 4 * sigma + 1e-5 * b);
        }
    }
}

TEST_CASE("Seed item f: with one light there is no noise, and the blocked one is black",
          "[device][seed]") {
    RenderDevice device(choose_device(""));
    Progress quiet(Progress::Mode::quiet);
    for (std::size_t removed : {0u, 1u}) {
        for (bool blocker : {false, true}) {
            Scene scene = plane_with_lights(blocker);
            scene.emitters.erase(scene.emitters.begin() + static_cast<std::ptrdiff_t>(removed));
            scene.sampler.samples_per_pixel = 16;
            double truth = 0.5 / M_PI * (removed ? 40 * light_a : 100 * light_b);
            if (blocker && removed) truth = 0;
            CAPTURE(removed, blocker);
            CHECK(channel(render(scene, device, {}, quiet), "R") == Approx(truth).epsilon(2e-5));
        }
    }
}

TEST_CASE(
    "Seed item e: the normals view of the bunny equals normals interpolated at the host's own hits",
    "[device][seed]") {
    if (!std::filesystem::exists("/usr/share/glmark2/models/bunny.obj")) {
        test::skip("no bunny (Debian package glmark2-data)");
        return;
    }
    LoadOptions load;
    load.allow_outside = true;
    Scene scene = load_scene(PARHELION_SOURCE_DIR "/scenes/bunny/normals.xml", load);
    scene.film.width = scene.film.height = scene.film.crop_width = scene.film.crop_height = 20;
    scene.film.crop_x = scene.film.crop_y = 0;
    scene.sampler.samples_per_pixel = 1;
    Progress quiet(Progress::Mode::quiet);
    RenderDevice device(choose_device(""));
    RenderResult result = render(scene, device, {}, quiet);
    DeviceScene flat = make_device_scene(scene);
    std::vector<PrimitiveRecord> primitives = test::single_primitives(flat.geometry);
    CameraRecord record = camera_record(scene.camera, 20, 20, flat.frame);
    f32::Camera camera{};
#define COPY_FIELD(type, name) camera.name = record.name;
    CAMERA_FIELDS(COPY_FIELD)
    int hits = 0, wrong = 0;
    for (int pixel = 0; pixel < 400; pixel++) {
        auto r =
            f32::faure4({static_cast<unsigned>(pixel), scene.sampler.seed, 0, 0}, f32::draw_camera);
        int x = pixel % 20, y = pixel / 20;
        f32::vec2 film = {static_cast<float>(x) + .5f + (f32::uniform01(r.x) - .5f),
                          static_cast<float>(y) + .5f + (f32::uniform01(r.y) - .5f)};
        auto ray = f32::camera_ray(camera, film, {0, 0});
        rays::Ray test_ray{{ray.origin.x, ray.origin.y, ray.origin.z},
                           {ray.direction.x, ray.direction.y, ray.direction.z}};
        rays::Hit hit = rays::brute_force(primitives, test_ray);
        double expected[3] = {0, 0, 0};
        if (hit.primitive >= 0) {
            hits++;
            const PrimitiveRecord& p = primitives[static_cast<std::size_t>(hit.primitive)];
            rays::ReadyRay ready(test_ray);
            f32::Intersection i =
                rays::intersect(geometry_triangle, rays::column_of(p), ready, INFINITY);
            // In double from here: the device's float arithmetic is allowed its roundings.
            const IndexedPrimitiveRecord& corners =
                flat.geometry.primitives[static_cast<std::size_t>(hit.primitive)];
            auto normal = [&](int point) {
                const float* n = &flat.geometry.points[static_cast<std::size_t>(point)] + 3;
                return glm::dvec3(n[0], n[1], n[2]);
            };
            double b1 = i.b1, b2 = i.b2, b0 = 1 - b1 - b2;
            glm::dvec3 n = b0 * normal(corners.a) + b1 * normal(corners.b) + b2 * normal(corners.c);
            if (!(p.flags & PRIMITIVE_NORMALS))
                n = glm::cross(glm::dvec3(p.bx - p.ax, p.by - p.ay, p.bz - p.az),
                               glm::dvec3(p.cx - p.ax, p.cy - p.ay, p.cz - p.az));
            n = glm::normalize(n);
            for (int k = 0; k < 3; k++)
                expected[k] = (n[k] + 1) / 2;
        }
        for (int k = 0; k < 3; k++) {
            const char* names[] = {"R", "G", "B"};
            float found =
                find_channel(result.image, names[k])->values[static_cast<std::size_t>(pixel)];
            wrong += !(std::fabs(found - expected[k]) <= 4e-7);
        }
    }
    CHECK(hits > 150);
    CHECK(wrong == 0);
}
