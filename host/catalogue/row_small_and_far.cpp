// Lights far smaller than the distance to what they light, and cameras far further away than what
// they see is large, against closed forms.
#include "host/catalogue/rows.h"

#include "host/catalogue/row_images.h"
#include "host/numerics/every_kind_scene.h"
#include "host/scene/mitsuba/transforms.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace parhelion::stress {
namespace {

constexpr double pi = std::numbers::pi, albedo = 0.5;

Scene diffuse_scene(int side, int spp) {
    Scene scene;
    scene.file = "made by the test";
    scene.materials.push_back({"", {}, DiffuseBsdf{Rgb(albedo)}});
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = side;
    scene.film.pixel_format = PixelFormat::rgba;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 2;
    scene.sampler.samples_per_pixel = spp;
    return scene;
}

double mean_of(const Image& image, const std::string& channel) {
    const std::vector<float>& values = find_channel(image, channel)->values;
    double sum = 0;
    for (float v : values)
        sum += v;
    return sum / static_cast<double>(values.size());
}

// ---- small lights

/// A light that is `size` wide about (0, 0, height) and shines down, and what it has of the area of
/// a square of that width, as seen from below.
struct Lamp {
    const char* name;
    Geometry geometry;
    double share;
};

constexpr double height = 1.5;

std::vector<Lamp> lamps(double size) {
    double h = 0.5 * size;
    Mesh square = quad({-h, -h, height}, {0, size, 0}, {size, 0, 0});
    Mesh triangle = square;
    triangle.triangles.resize(1);
    Disk disk{{0, 0, height}, {h, 0, 0}, {0, h, 0}, true};
    return {{"square", square, 1},
            {"triangle", triangle, 0.5},
            {"disk", disk, pi / 4},
            {"sphere", Sphere{{0, 0, height}, h}, pi / 4}};
}

/// The floor below the lamp, in so small a view that it is evenly lit.
Scene lit_floor(const Lamp& lamp, double size) {
    Scene scene = diffuse_scene(8, 16);
    scene.shapes = {shape_of(quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}), 0, 0),
                    shape_of(lamp.geometry, 0, no_material, Rgb(0.8 / (size * size)))};
    scene.camera.to_world = mitsuba::look_at({0, -3, 3}, {0, 0, 0}, {0, 0, 1}, {scene.file, 0});
    scene.camera.fov_degrees = 0.01;
    return scene;
}

Checks small_lights(StressRun& run, int step, Check& bad) {
    constexpr int first = -3, last = -18; // powers of ten; wider ones are no points
    Checks checks;
    for (std::size_t kind = 0; kind < lamps(1).size(); kind++) {
        Check check{.target = 5e-6, .unit = "relative"};
        for (int power = first; power >= last; power -= step) {
            double size = std::pow(10, power);
            Lamp lamp = lamps(size)[kind];
            check.name = fmt::format("a {} of 1e{} to 1e{} lights a floor", lamp.name, first, last);
            double truth = 0.8 * lamp.share / (height * height) * albedo / pi;
            Image image = image_of(run, lit_floor(lamp, size), bad);
            double off = std::fabs(mean_of(image, "R") / truth - 1);
            if (!(off <= check.value))
                check.value = off, check.worst_at = fmt::format("1e{}", power);
            check.samples += image.pixel_count();
        }
        checks.push_back(check);
    }
    return checks;
}

// ---- far cameras

/// What fills a part of a view that is 2 wide, and how much of the light that comes along the view
/// its surface sends back, against one that faces it.
struct Seen {
    const char* name;
    Geometry geometry;
    double covers, facing;
    double nearest; // point of it on the axis, from the origin
};

Mesh cube(double side) {
    double h = 0.5 * side;
    Mesh m;
    for (const glm::dvec3& n : {glm::dvec3(h, 0, 0), {0, h, 0}, {0, 0, h}})
        for (double sign : {-1., 1.}) {
            glm::dvec3 u(n.y, n.z, n.x), v(n.z, n.x, n.y);
            Mesh face = quad(sign * n - u - v, 2. * (sign > 0 ? v : u), 2. * (sign > 0 ? u : v));
            auto base = static_cast<unsigned>(m.positions.size());
            m.positions.insert(m.positions.end(), face.positions.begin(), face.positions.end());
            for (const glm::uvec3& t : face.triangles)
                m.triangles.push_back(t + base);
        }
    return m;
}

/// Along the diagonal of a cube all of its faces are seen alike.
std::vector<Seen> things() {
    double side = 0.6;
    return {{"ball", Sphere{{0, 0, 0}, 0.5}, pi * 0.25 / 4, 2. / 3, 0.5},
            {"cube", cube(side), std::sqrt(3) * side * side / 4, 1 / std::sqrt(3),
             side * std::sqrt(3) / 2}};
}

Scene seen_from(const Seen& thing, double distance, double lens) {
    Scene scene = diffuse_scene(64, 16);
    scene.shapes = {shape_of(thing.geometry, 0, no_material)};
    scene.emitters = {DirectionalEmitter{glm::dvec3(-1 / std::sqrt(3)), Rgb(pi)}};
    Camera& camera = scene.camera;
    camera.to_world = mitsuba::look_at(glm::dvec3(distance / std::sqrt(3)), {0, 0, 0}, {0, 0, 1},
                                       {scene.file, 0});
    camera.fov_degrees = 2 * std::atan(1 / distance) * 180 / pi;
    camera.far_clip = 2 * distance;
    camera.aperture_radius = lens, camera.focus_distance = distance;
    scene.integrator.aovs = {{"dd", "depth", {}}};
    return scene;
}

Checks far_cameras(StressRun& run, int step, Check& bad) {
    constexpr int first = 4, last = 12; // powers of ten; nearer ones see in perspective
    Checks checks;
    for (const Seen& thing : things())
        for (double lens : {0., 0.01}) {
            std::string from = fmt::format("a {} from 1e{} to 1e{}{}", thing.name, first, last,
                                           lens > 0 ? ", through a lens" : "");
            Check covers{.name = from + ": alpha", .target = 2e-3, .unit = "relative"},
                shines{.name = from + ": radiance", .target = 2e-3, .unit = "relative"},
                depth{.name = from + ": depth on the axis", .target = 5e-6, .unit = "relative"};
            for (int power = first; power <= last; power += step) {
                double distance = std::pow(10, power);
                Image image = image_of(run, seen_from(thing, distance, lens), bad);
                auto add = [&](Check& check, double value, double truth) {
                    double off = std::fabs(value / truth - 1);
                    if (!(off <= check.value))
                        check.value = off, check.worst_at = fmt::format("1e{}", power);
                    check.samples += image.pixel_count();
                };
                add(covers, mean_of(image, "A"), thing.covers);
                add(shines, mean_of(image, "R"), thing.covers * thing.facing * albedo);
                std::size_t middle =
                    image.pixel_count() / 2 + static_cast<std::size_t>(image.width) / 2;
                add(depth, find_channel(image, "dd.T")->values[middle],
                    distance - thing.nearest - Camera{}.near_clip);
            }
            checks.insert(checks.end(), {covers, shines, depth});
        }
    return checks;
}

} // namespace

Checks row_small_and_far(StressRun& run) {
    Check bad = bad_samples_check("small and far");
    auto step = static_cast<int>(run.count(4, 1, 1)); // powers of ten
    Checks checks = small_lights(run, step, bad);
    run.done(0.5);
    Checks far = far_cameras(run, step, bad);
    checks.insert(checks.end(), far.begin(), far.end());
    checks.push_back(bad);
    return checks;
}

} // namespace parhelion::stress
