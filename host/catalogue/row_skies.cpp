// Skies of images: what is seen of them against their definition in double, directions chosen by
// them against integrals over their cells, densities against those stated.
#include "host/catalogue/rows.h"
#include "host/catalogue/sky_draws.h"

#include "host/numerics/every_kind_scene.h"
#include "host/numerics/sky_images.h"
#include "host/numerics/statistics.h"
#include "host/twin/device_functions.h"

#include <fmt/format.h>

namespace parhelion::stress {
namespace {

std::array<float, 3> single(f32::vec3 w) { return {w.x, w.y, w.z}; }

/// Off by how much of the largest texel about: a direction is known to 2^-22, of which the steepest
/// slope makes so much.
Worst worst_radiance(const SkyImage& image, const DeviceScene& flat, std::uint64_t count,
                     Random& random) {
    double brightest = *std::max_element(image.values.begin(), image.values.end());
    Worst worst;
    for (std::uint64_t i = 0; i < count; i++) {
        f32::vec3 w = random.direction<F32>();
        // Near a pole, too.
        if (i % 4 == 0) w = normalize3(f32::v3(w.x * 1e-4f, w.y, w.z * 1e-4f));
        double seen = sky_seen(flat, single(w)).radiance[0];
        double height = std::hypot(double{w.x}, double{w.z});
        double slope = image.width / (2 * std::numbers::pi * height) + image.rows;
        worst.add(std::fabs(seen - image.radiance(wide(w))) / (brightest * (1 + slope)));
    }
    return worst;
}

struct Draws {
    double p = 1; ///< chi-square over the cells
    SkyWorst worst;
    double mean = 0, variance = 0; ///< of the weights
};

Draws draw(const SkyImage& image, const DeviceScene& flat, std::uint64_t count, Random& random) {
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t cells = width * static_cast<std::size_t>(image.rows - 1);
    std::vector<double> observed(cells), expected(cells);
    double whole = 0;
    for (std::size_t cell = 0; cell < cells; cell++)
        whole += expected[cell] =
            image.cell_integral(int(cell) % image.width, int(cell) / image.width, 64);
    for (double& e : expected)
        e *= double(count) / whole;
    Draws draws;
    double sum = 0, squares = 0;
    for (std::uint64_t i = 0; i < count; i++) {
        std::uint32_t x = random.bits(), y = random.bits();
        SkyDirection chosen = sky_chosen(flat, x, y);
        sum += chosen.weight[0], squares += double{chosen.weight[0]} * chosen.weight[0];
        f64::vec3 w = f64::v3(chosen.wi[0], chosen.wi[1], chosen.wi[2]);
        auto [turn, fall] = SkyImage::turn_and_fall(w);
        int column = int(std::floor(turn * image.width - 0.5) + image.width) % image.width;
        int row = std::min(int(fall * (image.rows - 1)), image.rows - 2);
        observed[std::size_t(row) * width + std::size_t(column)]++;
        // At the border of a cell rounding may take the direction into the next one.
        double s = turn * image.width + 0.5, t = fall * (image.rows - 1);
        if (std::min({s - std::floor(s), std::ceil(s) - s, t - std::floor(t), std::ceil(t) - t}) <
            1e-3)
            continue;
        draws.worst.add(flat, chosen);
    }
    draws.p = chi_square_p(observed, expected);
    draws.mean = sum / double(count);
    draws.variance = squares / double(count) - draws.mean * draws.mean;
    return draws;
}

} // namespace

Checks row_skies(StressRun& run) {
    std::uint64_t count = run.count(20'000, 1'000'000, 20'000'000);
    const std::string row = "skies";
    Checks checks;
    std::vector<SkyImage> images = sky_images();
    Random random(run.seed);
    for (const SkyImage& image : images) {
        DeviceScene flat = make_device_scene(scene_under(image.name, envmap_of(image)));
        checks.push_back(
            sky_check(row, "what is seen, to the largest texel and its slope: " + image.name,
                      worst_radiance(image, flat, count, random).value(), 2e-7, "", count));
        Draws draws = draw(image, flat, count, random);
        checks.push_back(sky_check(row,
                                   "density of a direction, and asked for again: " + image.name,
                                   draws.worst.density.value(), 5e-3, "", count));
        checks.push_back(sky_check(row, "weight: radiance over density: " + image.name,
                                   draws.worst.weight.value(), 5e-3, "", count));
        Check drawn = sky_check(row, "chi-square over cells: " + image.name, draws.p,
                                sidak_level(0.01, images.size()), "p", count);
        drawn.at_least = true;
        checks.push_back(drawn);
        checks.push_back(sky_check(row,
                                   "variance of the weights to their mean squared: " + image.name,
                                   draws.variance / (draws.mean * draws.mean), 0.05, "", count));
        run.done(double(checks.size()) / double(5 * images.size()));
    }
    return checks;
}

} // namespace parhelion::stress
