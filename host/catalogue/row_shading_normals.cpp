// Coarse spheres with smooth normals: no light from below the true surface, no more light than
// there is, and the same light whichever strategy samples it.
#include "host/catalogue/rows.h"

#include "host/catalogue/row_images.h"
#include "host/numerics/smooth_spheres.h"
#include "host/numerics/statistics.h"

#include <fmt/format.h>

namespace parhelion::stress {
namespace {

constexpr int sphere_pixels = 48; // wide and high

Image image_of(StressRun& run, Scene scene, unsigned number = 0) {
    scene.sampler.seed = static_cast<std::uint32_t>(run.seed * 10) + number;
    return render_quietly(run, scene).image;
}

bool is_delta(const NamedBsdf& b) {
    return std::holds_alternative<ConductorBsdf>(b.bsdf) ||
           std::holds_alternative<DielectricBsdf>(b.bsdf);
}

/// One sample a pixel, so that a pixel is of one face.
Checks light_from_below(StressRun& run, const std::vector<NamedBsdf>& bsdfs) {
    auto size = static_cast<int>(run.count(sphere_pixels, 200, 1000));
    Scene scene = smooth_spheres(bsdfs, Spheres::open_to_the_right, size, 1);
    add_panel(scene, far_panel);
    scene.integrator.max_depth = 2;
    scene.integrator.aovs = {{"ng", "geo_normal", {}}, {"p", "position", {}}};
    Image image = image_of(run, scene);
    Checks checks;
    for (std::size_t k = 0; k < bsdfs.size(); k++) {
        if (bsdfs[k].transparent || is_delta(bsdfs[k])) continue;
        TurnedAway count = turned_away(image, static_cast<int>(k));
        checks.push_back({.name = bsdfs[k].name + ": lit by what is below the geometric horizon",
                          .value = static_cast<double>(count.lit),
                          .target = 0,
                          .unit = "pixels",
                          .samples = static_cast<std::uint64_t>(count.dark + count.lit)});
    }
    return checks;
}

/// A pixel's mean against 1, and all of a sphere's.
Check furnace_check(const Image& image, std::size_t sphere, int spp, const std::string& name) {
    double most = -INFINITY, sum = 0, covered = 0, count = sphere_pixels * sphere_pixels;
    std::string where;
    for (std::size_t i = 0; i < sphere_pixels * sphere_pixels; i++) {
        std::size_t at = sphere * sphere_pixels * sphere_pixels + i;
        if (channel(image, "shape.I")[at] == 0) continue;
        double value = channel(image, "R")[at],
               error = std::sqrt(channel(image, "variance.R")[at] / spp),
               over = (value - 1) / (error + 1e-6);
        sum += value, covered++;
        if (over <= most) continue;
        most = over;
        where = fmt::format("column {}, row {}: {:.6f} +- {:.1e}", i % sphere_pixels,
                            i / sphere_pixels, value, error);
    }
    return {.name = name + ": white furnace, pixels above 1, smallest p",
            .value = normal_two_sided(std::max(most, 0.)),
            .target = sidak_level(0.01, static_cast<std::size_t>(count)),
            .at_least = true,
            .unit = "p",
            .samples = static_cast<std::uint64_t>(covered * spp),
            .worst_at = where,
            .note = fmt::format("returns {:.4f} of the light", sum / covered)};
}

Checks furnaces(StressRun& run, const std::vector<NamedBsdf>& bsdfs) {
    auto spp =
        static_cast<int>(run.count(512, 1024, 16'384)); // fewer are too skewed for a normal law
    Scene scene = smooth_spheres(bsdfs, Spheres::closed, sphere_pixels, spp);
    scene.emitters = {ConstantEmitter{Rgb(1)}};
    scene.integrator.aovs = {{"shape", "shape_index", {}}, {"variance", "variance", {}}};
    Image image = image_of(run, scene);
    Checks checks;
    for (std::size_t k = 0; k < bsdfs.size(); k++)
        checks.push_back(furnace_check(image, k, spp, bsdfs[k].name));
    return checks;
}

/// Mirror images that go into the sphere would be dark.
Checks mirror_furnace(StressRun& run) {
    Scene scene = smooth_spheres({{"mirror", ConductorBsdf{{Rgb(0), Rgb(1)}, Rgb(1)}}},
                                 Spheres::closed, 200, 16);
    scene.emitters = {ConstantEmitter{Rgb(1)}};
    Image image = image_of(run, scene);
    double worst = 0;
    for (float value : channel(image, "R"))
        worst = std::max(worst, std::fabs(value - 1.));
    return {{.name = "mirror under a uniform sky: pixels off 1",
             .value = worst,
             .target = 1e-6,
             .unit = "relative",
             .samples = image.pixel_count()}};
}

/// Sum of a sphere's pixels and its variance.
struct Sum {
    double value = 0, variance = 0;
};

Sum sum_of(const Image& image, std::size_t sphere, int spp) {
    Sum sum;
    for (std::size_t i = 0; i < sphere_pixels * sphere_pixels; i++) {
        std::size_t at = sphere * sphere_pixels * sphere_pixels + i;
        sum.value += channel(image, "R")[at];
        sum.variance += channel(image, "variance.R")[at] / spp;
    }
    return sum;
}

/// The panel's direct light by one strategy, beside that by both.
Checks strategies(StressRun& run, std::vector<NamedBsdf> bsdfs) {
    std::erase_if(bsdfs, is_delta);
    auto spp = static_cast<int>(run.count(64, 1024, 65'536));
    Scene scene = smooth_spheres(bsdfs, Spheres::closed, sphere_pixels, spp);
    add_panel(scene, near_panel);
    Integrator& integrator = scene.integrator;
    integrator.kind = IntegratorKind::direct;
    integrator.aovs = {{"variance", "variance", {}}};
    Image both = image_of(run, scene);
    Checks checks;
    for (bool of_light : {true, false}) {
        integrator.emitter_samples = of_light, integrator.bsdf_samples = !of_light;
        Image one = image_of(run, scene, of_light ? 1 : 2);
        for (std::size_t k = 0; k < bsdfs.size(); k++) {
            Sum a = sum_of(one, k, spp), b = sum_of(both, k, spp);
            double error = std::sqrt(a.variance + b.variance);
            checks.push_back(
                {.name = fmt::format("{}: samples of the {} alone, against both", bsdfs[k].name,
                                     of_light ? "light" : "bsdf"),
                 .value = normal_two_sided((a.value - b.value) / error),
                 .target = sidak_level(0.01, 2 * bsdfs.size()),
                 .at_least = true,
                 .unit = "p",
                 .samples = static_cast<std::uint64_t>(spp) * sphere_pixels * sphere_pixels,
                 .note = fmt::format("{:+.2e} +- {:.1e}, relative", a.value / b.value - 1,
                                     1.96 * error / b.value)});
        }
    }
    return checks;
}

} // namespace

Checks row_shading_normals(StressRun& run) {
    std::vector<NamedBsdf> bsdfs = white_bsdfs();
    Checks checks;
    auto add = [&](const Checks& more, double done) {
        checks.insert(checks.end(), more.begin(), more.end());
        run.done(done);
    };
    add(light_from_below(run, bsdfs), 0.1);
    add(mirror_furnace(run), 0.2);
    add(furnaces(run, bsdfs), 0.6);
    add(strategies(run, bsdfs), 1);
    return checks;
}

} // namespace parhelion::stress
