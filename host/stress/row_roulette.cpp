// Russian roulette on and off, over many seeds: the same means (Welch's t-test, whose p-values are
// uniform), and paths that it did end.
#include "host/stress/rows.h"

#include "host/render/path_tracer.h"
#include "host/stress/statistics.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace parhelion::stress {
namespace {

constexpr int group_size = 8; // seeds of one t-test, on each side

Shape shape_of(Geometry geometry, int material, bool both_sides, std::optional<Rgb> radiance = {}) {
    Shape s;
    s.geometry = std::move(geometry);
    s.material_front = material, s.material_back = both_sides ? material : no_material;
    s.radiance = radiance;
    return s;
}

Mesh square(glm::dvec3 a, glm::dvec3 u, glm::dvec3 v) {
    Mesh m;
    m.positions = {a, a + u, a + u + v, a + v};
    m.triangles = {{0, 1, 2}, {0, 2, 3}};
    return m;
}

/// A bright room, a lamp, a ball of glass and one of metal: paths are long, and go through glass.
/// `first`: vertices before roulette begins.
Scene room(int first) {
    Scene scene;
    scene.materials = {{"", {}, DiffuseBsdf{Rgb(0.8, 0.6, 0.3)}},
                       {"", {}, DielectricBsdf{}},
                       {"", {}, RoughConductorBsdf{}}};
    const glm::dvec3 x(4, 0, 0), y(0, 4, 0), z(0, 0, 4), low(-2, -2, -2);
    for (const Mesh& wall : {square(low, x, y), square(low + z, x, y), square(low, x, z),
                             square(low + y, x, z), square(low, y, z), square(low + x, y, z)})
        scene.shapes.push_back(shape_of(wall, 0, true));
    scene.shapes.push_back(shape_of(square({-0.5, 1.9, -0.5}, {1, 0, 0}, {0, 0, 1}), 0, false,
                                    Rgb(9, 8, 7))); // shines down
    scene.shapes.push_back(shape_of(Sphere{{-0.8, -1.2, 0.3}, 0.7}, 1, true));
    scene.shapes.push_back(shape_of(Sphere{{0.9, -1.3, 0.6}, 0.6}, 2, false));
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

struct RenderedMean {
    std::array<double, 3> rgb{};
    double rays = 0, bad_samples = 0;
};

RenderedMean image_mean(StressRun& run, Scene& scene, std::uint32_t seed) {
    Progress quiet(Progress::Mode::quiet);
    scene.sampler.seed = seed;
    RenderResult result = render(scene, run.device, {}, quiet);
    RenderedMean m{{},
                   static_cast<double>(result.report.bounce_rays),
                   static_cast<double>(result.report.non_finite_samples)};
    for (std::size_t c = 0; c < 3; c++) {
        for (float v : find_channel(result.image, std::string(1, "RGB"[c]))->values)
            m.rgb[c] += v;
        m.rgb[c] /= static_cast<double>(result.image.pixel_count());
    }
    return m;
}

/// Over some seeds.
struct Images {
    std::array<Mean, 3> mean;
    double rays = 0, bad_samples = 0;
};

void add(Images& images, const RenderedMean& m) {
    for (std::size_t c = 0; c < 3; c++)
        images.mean[c].add(m.rgb[c]);
    images.rays += m.rays, images.bad_samples += m.bad_samples;
}

/// Welch's t-test of two means of n values each, with the degrees of freedom of Welch and
/// Satterthwaite, rounded.
double welch_p(const Mean& a, const Mean& b, int n) {
    double va = a.error() * a.error(), vb = b.error() * b.error();
    double freedom = (va + vb) * (va + vb) / ((va * va + vb * vb) / (n - 1));
    return student_two_sided((a.mean() - b.mean()) / std::sqrt(va + vb),
                             static_cast<int>(std::lround(freedom)));
}

} // namespace

Checks row_roulette(StressRun& run) {
    int groups = static_cast<int>(run.count(4, 16, 125)), seeds = groups * group_size;
    Scene with = room(2), without = room(1000);
    auto seed = static_cast<std::uint32_t>(run.seed * 100'000);
    std::array<std::vector<double>, 3> p_values;
    Images with_it, without_it, with_group, without_group;
    for (int n = 0; n < seeds; n++) {
        RenderedMean a = image_mean(run, with, seed++), b = image_mean(run, without, seed++);
        for (Images* images : {&with_it, &with_group})
            add(*images, a);
        for (Images* images : {&without_it, &without_group})
            add(*images, b);
        if ((n + 1) % group_size == 0) {
            for (std::size_t c = 0; c < 3; c++)
                p_values[c].push_back(
                    welch_p(with_group.mean[c], without_group.mean[c], group_size));
            with_group = without_group = Images();
        }
        run.done(static_cast<double>(n + 1) / seeds);
    }
    Checks checks;
    auto p_check = [&](const std::string& name, double p, std::uint64_t samples) {
        checks.push_back({.name = "roulette on and off, " + name,
                          .value = p,
                          .target = sidak_level(0.01, 6),
                          .at_least = true,
                          .unit = "p",
                          .samples = samples});
    };
    for (std::size_t c = 0; c < 3; c++) {
        const Mean &a = with_it.mean[c], &b = without_it.mean[c];
        std::string channel(1, "RGB"[c]);
        p_check(channel + ": means", welch_p(a, b, seeds), seeds);
        checks.back().note =
            fmt::format("difference {:+.2e} +- {:.2e} (95 %), relative", a.mean() / b.mean() - 1,
                        1.96 * std::hypot(a.error(), b.error()) / b.mean());
        p_check(channel + ": p-values of groups of seeds are uniform",
                kolmogorov_smirnov_p(p_values[c]), p_values[c].size());
    }
    checks.push_back({.name = "roulette: rays that it leaves, of those without",
                      .value = with_it.rays / without_it.rays,
                      .target = 0.9, // or it would have tested nothing
                      .unit = "share",
                      .samples = static_cast<std::uint64_t>(without_it.rays)});
    checks.push_back({.name = "roulette: samples that are not finite",
                      .value = with_it.bad_samples + without_it.bad_samples,
                      .target = 0,
                      .unit = "samples"});
    return checks;
}

} // namespace parhelion::stress
