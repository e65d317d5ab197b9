// A grain beside a planet: how far single precision carries where a scene's sizes lie far apart.
#include "host/catalogue/rows.h"

#include "host/catalogue/row_images.h"
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

/// How far two images are apart, of the mean of the second.
struct Difference {
    double all;                  ///< root of the mean square, of all pixels
    double alike;                ///< of those whose paths decide alike
    std::uint64_t otherwise = 0; ///< the other pixels
};

/// A path that passes an edge within rounding may take its other side, and shows in its pixel by
/// far more than rounding does.
constexpr double decided_otherwise = 1e-4;

Difference difference(const Image& a, const Image& b) {
    std::vector<const std::vector<float>*> found, exact;
    for (const char* channel : {"R", "G", "B"}) {
        found.push_back(&find_channel(a, channel)->values);
        exact.push_back(&find_channel(b, channel)->values);
    }
    MeanRgb means = mean_rgb(b);
    double mean = (means[0] + means[1] + means[2]) / 3;
    double all = 0, alike = 0;
    Difference d{};
    for (std::size_t i = 0; i < b.pixel_count(); i++) {
        double square = 0, worst = 0;
        for (std::size_t c = 0; c < 3; c++) {
            double off = std::fabs(double{(*found[c])[i]} - double{(*exact[c])[i]}) / mean;
            square += off * off, worst = std::max(worst, off);
        }
        bool same = worst <= decided_otherwise;
        all += square, alike += same ? square : 0, d.otherwise += !same;
    }
    auto values = 3. * static_cast<double>(b.pixel_count());
    d.all = std::sqrt(all / values), d.alike = std::sqrt(alike / values);
    return d;
}

struct Ground {
    const char* name;
    Geometry geometry;
};

/// Two checks. `finished`: images of the row's that are done.
Checks on_ground(StressRun& run, const Ground& ground, Check& bad, int& finished) {
    Check off{.name = fmt::format("a grain on a {} of 1e7, from {:.0e} on: off double precision",
                                  ground.name, std::pow(10, promised)),
              .target = 1e-5,
              .unit = "of the mean",
              .curve = {"log10 of the grain's radius", smallest, largest + 1, {}}};
    Check otherwise{.name =
                        fmt::format("a grain on a {}: paths that decide otherwise", ground.name),
                    .target = 2e-4,
                    .unit = "of the samples"};
    for (int power = smallest; power <= largest; power++) {
        Scene scene = scene_of(ground.geometry, std::pow(10, power));
        scene.sampler.samples_per_pixel = static_cast<int>(run.count(4, 16, 256));
        scene.sampler.seed = static_cast<std::uint32_t>(run.seed);
        Image device = image_of(run, scene, bad);
        Progress quiet(Progress::Mode::quiet);
        Image exact = render_on_host(scene, {}, Precision::double_precision, quiet).image;
        Difference d = difference(device, exact);
        off.curve.worst.push_back(d.all);
        off.note += fmt::format("{}1e{}: {:.2g}", power > smallest ? ", " : "", power, d.all);
        off.samples += 3 * device.pixel_count();
        run.done(++finished / (2. * (largest - smallest + 1)));
        if (power < promised) continue;
        off.value = std::max(off.value, d.alike);
        otherwise.value += static_cast<double>(d.otherwise);
        otherwise.samples +=
            device.pixel_count() * static_cast<std::uint64_t>(scene.sampler.samples_per_pixel);
    }
    otherwise.value /= static_cast<double>(otherwise.samples);
    return {off, otherwise};
}

} // namespace

Checks row_grain_and_planet(StressRun& run) {
    const Ground grounds[] = {
        {"plate", quad({-planet, -planet, 0}, {2 * planet, 0, 0}, {0, 2 * planet, 0})},
        {"ball", Sphere{{0, 0, -planet}, planet}}};
    Check bad = bad_samples_check("grain and planet");
    Checks checks;
    int finished = 0;
    for (const Ground& ground : grounds)
        for (const Check& check : on_ground(run, ground, bad, finished))
            checks.push_back(check);
    checks.push_back(bad);
    return checks;
}

} // namespace parhelion::stress
