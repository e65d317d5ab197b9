// Suns and skies by their formula: what is seen of them against double precision, directions chosen
// by them against the integral of the density that is asked for again, their light against its
// integral.
#include "host/catalogue/rows.h"
#include "host/catalogue/sky_draws.h"

#include "host/flatten/daylight.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/measure.h"
#include "host/numerics/statistics.h"
#include "host/twin/device_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace parhelion::stress {
namespace {

constexpr double pi = std::numbers::pi;

struct Case {
    std::string name;
    SunskyEmitter emitter;
};

/// In the sky's own frame.
SunskyEmitter daylight(double turbidity, double elevation, double aperture, double sun,
                       double sky) {
    SunskyEmitter e;
    e.turbidity = turbidity;
    double level = std::cos(elevation);
    e.sun = {0.6 * level, std::sin(elevation), 0.8 * level};
    e.half_aperture = 0.5 * aperture;
    e.sun_scale = sun, e.sky_scale = sky;
    return e;
}

std::vector<Case> cases() {
    constexpr double disk = 0.00935148; // of the sun
    return {{"a clear day", daylight(3, 0.8, disk, 1, 1)},
            {"its sky", daylight(3, 0.8, disk, 0, 1)},
            {"a sky of haze at sunset", daylight(10, 0.01, disk, 0, 1)},
            {"a wide sun", daylight(2, 1.2, 0.5, 1, 0)},
            {"a narrow sun", daylight(6, 0.3, 1e-3, 1, 0)},
            {"a dim sun in the zenith", daylight(1, 0.5 * pi, disk, 0.02, 1)}};
}

std::array<float, 3> single(const glm::dvec3& w) {
    return {static_cast<float>(w.x), static_cast<float>(w.y), static_cast<float>(w.z)};
}
glm::dvec3 wide3(const std::array<float, 3>& w) { return {w[0], w[1], w[2]}; }

/// Cells of the sky, over which the density by its table is bilinear in azimuth and cosine, and of
/// the sun's disk.
struct Cells {
    static constexpr int around = 64, down = 16; // of the sky, by angle
    static constexpr int sides = 16;             // of the sun's disk, by area and angle
    static constexpr int sky = around * down, all = sky + sides * sides;

    Daylight sun;
    f64::ShadingFrame frame;

    explicit Cells(const Case& c) : sun(daylight_of(c.emitter)) {
        const glm::dvec3& d = sun.direction;
        frame = f64::frame_from_normal(f64::v3(d.x, d.y, d.z));
    }

    std::size_t of(const glm::dvec3& w) const {
        glm::dvec3 apart = w - sun.direction;
        double share = glm::dot(apart, apart) / sun.edge;
        if (!sun.sun || share > 1.001) return of_sky(w); // single precision is off as much
        f64::vec3 v = to_local(frame, f64::v3(w.x, w.y, w.z));
        double turn = std::atan2(v.y, v.x) / (2 * pi) + 0.5;
        int ring = std::min(int(share * sides), sides - 1);
        return std::size_t(sky + ring * sides + std::min(int(turn * sides), sides - 1));
    }
    static std::size_t of_sky(const glm::dvec3& w) {
        double turn = std::atan2(w.x, -w.z) / (2 * pi) - 0.5 / around;
        double fall = std::atan2(std::hypot(w.x, w.z), w.y) / (0.5 * pi);
        int column = std::min(int((turn - std::floor(turn)) * around), around - 1);
        return std::size_t(std::min(int(fall * down), down - 1) * around + column);
    }
    /// Its middle, and its solid angle.
    std::pair<glm::dvec3, double> middle(int cell) const {
        if (cell >= sky) {
            int ring = (cell - sky) / sides, sector = (cell - sky) % sides;
            double lost = 0.5 * sun.edge * (ring + 0.5) / sides, phi = 0;
            double sine = std::sqrt(lost * (2 - lost));
            phi = 2 * pi * ((sector + 0.5) / sides - 0.5);
            f64::vec3 w =
                to_world(frame, f64::v3(sine * std::cos(phi), sine * std::sin(phi), 1 - lost));
            return {{w.x, w.y, w.z}, sun.solid_angle() / (sides * sides)};
        }
        int row = cell / around;
        double first = 0.5 * pi * row / down, height = 0.5 * pi / down;
        double cosines = std::cos(first) - std::cos(first + height);
        double y = std::cos(first) - 0.5 * cosines, r = std::sqrt(1 - y * y);
        double phi = 2 * pi * (cell % around + 1.0) / around;
        return {{r * std::sin(phi), y, -r * std::cos(phi)}, cosines * 2 * pi / around};
    }
    /// Of the density that is asked for: of what the sun's disk covers none is the sky's.
    std::vector<double> masses(const DeviceScene& flat) const {
        std::vector<double> mass(all), covered(sky);
        for (int cell = all - 1; cell >= 0; cell--) {
            auto [w, solid_angle] = middle(cell);
            double density = sky_seen(flat, single(w)).pdf;
            if (cell >= sky) {
                if (!sun.sun) continue;
                covered[of_sky(w)] += solid_angle;
            } else {
                solid_angle -= std::min(covered[std::size_t(cell)], solid_angle);
                if (of(w) >= std::size_t(sky)) density = 0; // its middle is
            }
            mass[std::size_t(cell)] = density * solid_angle;
        }
        return mass;
    }
};

struct Draws {
    double p = 1;     ///< chi-square over the cells
    double whole = 0; ///< integral of the density
    SkyWorst worst;
    double mean = 0, sigma = 0; ///< of the weights' red, and its standard error
};

Draws draw(const Case& c, const DeviceScene& flat, std::uint64_t count, Random& random) {
    const Cells cells(c);
    std::vector<double> observed(Cells::all), expected(Cells::all);
    Draws draws;
    double squares = 0;
    for (std::uint64_t i = 0; i < count; i++) {
        SkyDirection chosen = sky_chosen(flat, random.bits(), random.bits());
        draws.mean += chosen.weight[0], squares += double{chosen.weight[0]} * chosen.weight[0];
        observed[cells.of(wide3(chosen.wi))]++;
        glm::dvec3 apart = wide3(chosen.wi) - cells.sun.direction;
        bool at_edge = std::fabs(glm::length(apart) / std::sqrt(cells.sun.edge) - 1) < 1e-2;
        if (at_edge || chosen.wi[1] < 1e-5F) continue; // rounding may take it across
        draws.worst.add(flat, chosen);
    }
    std::vector<double> masses = cells.masses(flat);
    for (std::size_t cell = 0; cell < masses.size(); cell++)
        expected[cell] = masses[cell] * double(count), draws.whole += masses[cell];
    draws.p = chi_square_p(observed, expected);
    draws.mean /= double(count);
    double variance = squares / double(count) - draws.mean * draws.mean;
    draws.sigma = std::sqrt(std::max(variance, 0.0) / double(count));
    return draws;
}

/// Red of all directions together.
double light_of(const Daylight& d) {
    constexpr int around = 1024, down = 1024;
    double sum = 0;
    for (int j = 0; j < down && d.sky; j++)
        for (int i = 0; i < around; i++) {
            double y = (j + 0.5) / down, r = std::sqrt(1 - y * y);
            double phi = 2 * pi * (i + 0.5) / around;
            sum += d.sky_radiance({r * std::cos(phi), y, r * std::sin(phi)}).r;
        }
    return sum * 2 * pi / (double(around) * down) + d.sun_radiance.r * d.solid_angle();
}

double largest(const Rgb& c) { return std::max({std::fabs(c.r), std::fabs(c.g), std::fabs(c.b)}); }

/// Of the sky's radiance, to its largest colour and a hundredth of that about the sun: at dawn some
/// of the sky is nearly black, and the formula a difference of numbers 50 times as large.
Worst worst_radiance(const Case& c, const DeviceScene& flat, std::uint64_t count, Random& random) {
    const Daylight d = daylight_of(c.emitter);
    Worst worst;
    for (std::uint64_t i = 0; i < count && d.sky; i++) {
        f32::vec3 v = random.direction<F32>();
        glm::dvec3 w(v.x, std::fabs(v.y), v.z);
        if (d.sun && glm::length(w - d.direction) < 1.01 * std::sqrt(d.edge)) continue;
        Rgb truth = d.sky_radiance(w);
        worst.add(largest(truth - wide3(sky_seen(flat, single(w)).radiance)) /
                  (largest(truth) + 0.01 * largest(d.sky_radiance(d.direction))));
    }
    return worst;
}

} // namespace

Checks row_daylight(StressRun& run) {
    std::uint64_t count = run.count(20'000, 1'000'000, 20'000'000);
    const std::string row = "daylight";
    Checks checks;
    const std::vector<Case> all = cases();
    Random random(run.seed);
    for (const Case& c : all) {
        DeviceScene flat = make_device_scene(scene_under(c.name, c.emitter));
        checks.push_back(
            sky_check(row, "radiance of the sky, to it and a hundredth of the brightest: " + c.name,
                      worst_radiance(c, flat, count, random).value(), 1e-4, "", count));
        Draws draws = draw(c, flat, count, random);
        checks.push_back(sky_check(row, "density of a direction, and asked for again: " + c.name,
                                   draws.worst.density.value(), 5e-3, "", count));
        checks.push_back(sky_check(row, "weight: radiance over density: " + c.name,
                                   draws.worst.weight.value(), 5e-3, "", count));
        checks.push_back(sky_check(row, "integral of the density, off 1: " + c.name,
                                   std::fabs(draws.whole - 1), 1e-4, "", count));
        checks.push_back(
            sky_check(row, "light of all directions, standard errors off its integral: " + c.name,
                      std::fabs(draws.mean / light_of(daylight_of(c.emitter)) - 1) /
                          (draws.sigma / draws.mean + 1e-5),
                      5, "", count));
        Check drawn = sky_check(row, "chi-square over cells: " + c.name, draws.p,
                                sidak_level(0.01, all.size()), "p", count);
        drawn.at_least = true;
        checks.push_back(drawn);
        run.done(double(checks.size()) / double(6 * all.size()));
    }
    return checks;
}

} // namespace parhelion::stress
