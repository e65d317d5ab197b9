// Russian roulette on and off, over many seeds: the same means (Welch's t-test, whose p-values are
// uniform), and paths that it did end.
#include "host/catalogue/row_images.h"
#include "host/catalogue/rows.h"
#include "host/numerics/every_kind_scene.h"

#include "host/catalogue/welch.h"

namespace parhelion::stress {
namespace {

/// A bright room, a lamp, a ball of glass and one of metal: paths are long, and go through glass.
/// `first`: vertices before roulette begins.
Scene room(int first) {
    Scene scene;
    scene.materials = {{"", {}, DiffuseBsdf{Rgb(0.8, 0.6, 0.3)}},
                       {"", {}, DielectricBsdf{}},
                       {"", {}, RoughConductorBsdf{}}};
    const glm::dvec3 x(4, 0, 0), y(0, 4, 0), z(0, 0, 4), low(-2, -2, -2);
    for (const Mesh& wall : {quad(low, x, y), quad(low + z, x, y), quad(low, x, z),
                             quad(low + y, x, z), quad(low, y, z), quad(low + x, y, z)})
        scene.shapes.push_back(shape_of(wall, 0, 0));
    scene.shapes.push_back(shape_of(quad({-0.5, 1.9, -0.5}, {1, 0, 0}, {0, 0, 1}), 0, no_material,
                                    Rgb(9, 8, 7))); // shines down
    scene.shapes.push_back(shape_of(Sphere{{-0.8, -1.2, 0.3}, 0.7}, 1, 1));
    scene.shapes.push_back(shape_of(Sphere{{0.9, -1.3, 0.6}, 0.6}, 2, no_material));
    scene.camera.to_world[3] = glm::dvec4(0, 0, -1.9, 1);
    scene.camera.fov_degrees = 80;
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 16;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 16;
    scene.integrator.rr_depth = first;
    scene.sampler.pattern = SamplePattern::independent;
    scene.sampler.samples_per_pixel = 16;
    return scene;
}

MeanRgb image_mean(StressRun& run, Scene& scene, std::uint32_t seed, double& rays, Check& bad) {
    scene.sampler.seed = seed;
    RenderResult result = render_quietly(run, scene);
    rays += static_cast<double>(result.report.bounce_rays);
    add_bad_samples(bad, result.report);
    return mean_rgb(result.image);
}

} // namespace

Checks row_roulette(StressRun& run) {
    int groups = static_cast<int>(run.count(4, 16, 125));
    Scene with = room(2), without = room(1000);
    double rays_with = 0, rays_without = 0;
    Check bad = bad_samples_check("roulette");
    Checks checks = welch_checks(
        run, {.name = "roulette on and off", .groups = groups, .most_error = 0.03},
        [&](std::uint32_t seed) { return image_mean(run, with, seed, rays_with, bad); },
        [&](std::uint32_t seed) { return image_mean(run, without, seed, rays_without, bad); });
    checks.push_back({.name = "roulette: rays that it leaves, of those without",
                      .value = rays_with / rays_without,
                      .target = 0.9, // or it would have tested nothing
                      .unit = "share",
                      .samples = static_cast<std::uint64_t>(rays_without)});
    checks.push_back(bad);
    return checks;
}

} // namespace parhelion::stress
