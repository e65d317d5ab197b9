// A grain beside a planet: how far single precision carries where a scene's sizes lie far apart.
#include "host/catalogue/rows.h"

#include "host/catalogue/row_images.h"
#include "host/image/metrics.h"
#include "host/numerics/every_kind_scene.h"
#include "host/render/host_render.h"
#include "host/scene/mitsuba/transforms.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace parhelion::stress {
namespace {

constexpr double planet = 1e7;            // radius, or half a side
constexpr int smallest = -6, largest = 6; // powers of ten: radius of the grain
constexpr int promised = 5;

/// A ball of the radius `grain` that lies on the ground, looked at from four radii away, in the sun
/// under a sky.
Scene scene_of(const Geometry& ground, double grain) {
    Scene scene;
    scene.file = "made by the test";
    scene.materials.push_back({"", {}, DiffuseBsdf{Rgb(0.5)}});
    scene.shapes = {shape_of(ground, 0, 0), shape_of(Sphere{{0, 0, grain}, grain}, 0, no_material)};
    scene.emitters = {DirectionalEmitter{glm::normalize(glm::dvec3(0.3, 0.5, -1)), Rgb(3)},
                      ConstantEmitter{Rgb(0.3)}};
    scene.camera.to_world = mitsuba::look_at(
        glm::dvec3(-4, 0, 1.5) * grain, glm::dvec3(0, 0, 0.7) * grain, {0, 0, 1}, {scene.file, 0});
    scene.camera.fov_degrees = 40;
    scene.camera.near_clip = 1e-3 * grain, scene.camera.far_clip = 100 * planet;
    scene.film.width = scene.film.crop_width = 32;
    scene.film.height = scene.film.crop_height = 32;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 4;
    return scene;
}

/// Root of the mean square of what two images differ by, over the mean of the second.
double relative_difference(const Image& a, const Image& b) {
    std::vector<ChannelPair> pairs;
    for (const char* channel : {"R", "G", "B"})
        pairs.push_back(
            {channel, find_channel(a, channel)->values, find_channel(b, channel)->values});
    ErrorFigures all = compute_metrics(pairs, a.width, 0.01).all;
    return all.rmse / all.mean_reference;
}

} // namespace

Checks row_grain_and_planet(StressRun& run) {
    struct Ground {
        std::string name;
        Geometry geometry;
    };
    const Ground grounds[] = {
        {"plate", quad({-planet, -planet, 0}, {2 * planet, 0, 0}, {0, 2 * planet, 0})},
        {"ball", Sphere{{0, 0, -planet}, planet}}};
    Check bad = bad_samples_check("grain and planet");
    Checks checks;
    int finished = 0;
    for (const Ground& ground : grounds) {
        Check check{.name = fmt::format("a grain on a {} of 1e7, from {:.0e} on: off double "
                                        "precision",
                                        ground.name, std::pow(10, promised)),
                    .target = 1e-5,
                    .unit = "of the mean",
                    .curve = {"log10 of the grain's radius", smallest, largest + 1, {}}};
        for (int power = smallest; power <= largest; power++) {
            Scene scene = scene_of(ground.geometry, std::pow(10, power));
            scene.sampler.samples_per_pixel = static_cast<int>(run.count(4, 16, 256));
            Image device = image_of(run, scene, bad);
            Progress quiet(Progress::Mode::quiet);
            Image exact = render_on_host(scene, {}, Precision::double_precision, quiet).image;
            double off = relative_difference(device, exact);
            check.curve.worst.push_back(off);
            check.note += fmt::format("{}1e{}: {:.2g}", power > smallest ? ", " : "", power, off);
            if (power >= promised) check.value = std::max(check.value, off);
            check.samples += 3 * device.pixel_count();
            run.done(++finished / (2. * (largest - smallest + 1)));
        }
        checks.push_back(check);
    }
    checks.push_back(bad);
    return checks;
}

} // namespace parhelion::stress
