// Smooth materials, weights and roulette against the formulas as their papers print them, in
// double. A delta lobe tells its probability by where the number that chooses the lobe changes
// sides.
#include "host/numerics/measure.h"

#include "host/numerics/materials.h"

#include <catch2/catch.hpp>

#include <complex>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

/// Fresnel's equations in the angles of incidence and refraction (Born and Wolf, section 1.5.2),
/// unpolarised; n: index beyond over index here.
double reflectance(double c, double n) {
    double incidence = std::acos(c), sine = std::sin(incidence) / n;
    if (sine >= 1) return 1;
    double refraction = std::asin(sine);
    double s = std::sin(incidence - refraction) / std::sin(incidence + refraction);
    double p = std::tan(incidence - refraction) / std::tan(incidence + refraction);
    return (s * s + p * p) / 2;
}

double metal_reflectance(double c, std::complex<double> n) {
    std::complex<double> t = std::sqrt(1. - (1 - c * c) / (n * n));
    std::complex<double> s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    return (std::norm(s) + std::norm(p)) / 2;
}

f64::Material material(int kind, double index = 1.5) {
    bool transparent = !((OPAQUE_MATERIALS >> kind) & 1);
    return make_material<F64>({"",
                               kind,
                               transparent,
                               false,
                               {0.9, 0.7, 0.5},
                               {0.8, 0.6, 0.4},
                               {0.2, 0.9, 1.5},
                               {3.9, 2.4, 1.8},
                               index,
                               1,
                               1,
                               0});
}

f64::BsdfSample sample(const f64::Material& m, f64::vec3 wo, double lobe) {
    return bsdf_sample(m, wo, {0.3, 0.6}, lobe);
}

bool same_side(f64::vec3 a, f64::vec3 b) { return a.z * b.z > 0; }

/// The probability with which wo is reflected.
double reflected_share(const f64::Material& m, f64::vec3 wo) {
    double low = 0, high = 1;
    for (int n = 0; n < 60; n++) {
        double middle = (low + high) / 2;
        (same_side(sample(m, wo, middle).wi, wo) ? low : high) = middle;
    }
    return low;
}

f64::vec3 tilted(double cosine, double azimuth) {
    double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

void check_color(f64::vec3 found, double r, double g, double b) {
    CHECK(found.x == Approx(r).epsilon(1e-9));
    CHECK(found.y == Approx(g).epsilon(1e-9));
    CHECK(found.z == Approx(b).epsilon(1e-9));
}

void check_direction(f64::vec3 found, double x, double y, double z) {
    CHECK(found.x == Approx(x).margin(1e-9));
    CHECK(found.y == Approx(y).margin(1e-9));
    CHECK(found.z == Approx(z).margin(1e-9));
}

const double cosines[] = {0.999, 0.9, 0.7, 0.5, 0.3, 0.1, 0.01};

} // namespace

TEST_CASE("Papers: smooth glass from both sides", "[papers]") {
    for (double index : {1.5, 1.33, 1 / 1.5})
        for (double c : cosines)
            for (double side : {1., -1.}) {
                INFO("index " << index << " cosine " << c << " side " << side);
                f64::Material m = material(material_dielectric, index);
                double n = side > 0 ? index : 1 / index, r = reflectance(c, n);
                f64::vec3 wo = tilted(side * c, 0.4);
                CHECK(reflected_share(m, wo) == Approx(r).margin(1e-9));
                f64::BsdfSample up = sample(m, wo, 0);
                check_direction(up.wi, -wo.x, -wo.y, wo.z);
                check_color(up.weight, 0.9, 0.7, 0.5);
                CHECK(up.eta == 1);
                CHECK(std::isinf(up.pdf));
                if (r >= 1) continue;
                f64::BsdfSample down = sample(m, wo, 1 - 1e-12);
                // Snell's law; radiance is divided by the square of the index (Veach 1997, 5.2).
                double sine = 1 / n;
                check_direction(down.wi, -wo.x * sine, -wo.y * sine,
                                -side * std::sqrt(1 - (1 - c * c) / (n * n)));
                check_color(down.weight, 0.8 / (n * n), 0.6 / (n * n), 0.4 / (n * n));
                CHECK(down.eta == Approx(n));
                CHECK(std::isinf(down.pdf));
            }
}

TEST_CASE("Papers: a thin slab is the sum over reflections inside it, the same from both sides",
          "[papers]") {
    for (double index : {1.5, 2.0})
        for (double c : cosines)
            for (double side : {1., -1.}) {
                INFO("index " << index << " cosine " << c << " side " << side);
                f64::Material m = material(material_thindielectric, index);
                // R + T (R + R^3 + ...) T: every way out on the side of the viewer.
                double r = reflectance(c, index), sum = r, inside = r;
                for (int bounce = 0; bounce < 4000; bounce++, inside *= r * r)
                    sum += (1 - r) * (1 - r) * inside;
                f64::vec3 wo = tilted(side * c, 2.1);
                CHECK(reflected_share(m, wo) == Approx(sum).margin(1e-9));
                f64::BsdfSample up = sample(m, wo, 0), down = sample(m, wo, 1 - 1e-12);
                check_direction(up.wi, -wo.x, -wo.y, wo.z);
                check_color(up.weight, 0.9, 0.7, 0.5);
                check_direction(down.wi, -wo.x, -wo.y, -wo.z);
                check_color(down.weight, 0.8, 0.6, 0.4);
                CHECK(up.eta == 1);
                CHECK(down.eta == 1);
            }
}

TEST_CASE("Papers: smooth metal and null", "[papers]") {
    f64::Material metal = material(material_conductor), nothing = material(material_null);
    for (double c : cosines) {
        f64::vec3 wo = tilted(c, 5), below = tilted(-c, 5);
        f64::BsdfSample s = sample(metal, wo, 0.5);
        check_direction(s.wi, -wo.x, -wo.y, wo.z);
        check_color(s.weight, 0.9 * metal_reflectance(c, {0.2, 3.9}),
                    0.7 * metal_reflectance(c, {0.9, 2.4}), 0.5 * metal_reflectance(c, {1.5, 1.8}));
        check_color(sample(metal, below, 0.5).weight, 0, 0, 0);
        for (f64::vec3 w : {wo, below}) {
            s = sample(nothing, w, 0.5);
            check_direction(s.wi, -w.x, -w.y, -w.z);
            check_color(s.weight, 1, 1, 1);
            CHECK(std::isinf(s.pdf));
        }
    }
}

TEST_CASE("Papers: Lambert's law", "[papers]") {
    f64::Material m = material(material_diffuse);
    for (double c : cosines)
        for (double o : {0.6, -0.6}) {
            f64::BsdfEval e = bsdf_eval(m, tilted(o, 1), tilted(c, 2));
            double lit = o > 0 ? c / M_PI : 0;
            check_color(e.f, 0.9 * lit, 0.7 * lit, 0.5 * lit);
            CHECK(e.pdf == Approx(lit));
            CHECK(bsdf_eval(m, tilted(o, 1), tilted(-c, 2)).pdf == 0);
        }
    f64::BsdfSample s = sample(m, tilted(0.6, 1), 0.5);
    check_color(s.weight, 0.9, 0.7, 0.5);
    CHECK(s.pdf == Approx(s.wi.z / M_PI));
}

TEST_CASE("Papers: the power heuristic, Veach 1997, section 9.2.4", "[papers]") {
    for (double own : {0.01, 0.5, 3., 700.})
        for (double other : {0.02, 0.5, 8., 90.}) {
            double w = own * own / (own * own + other * other);
            CHECK(f64::power_heuristic(own, other) == Approx(w).epsilon(1e-12));
            CHECK(f64::power_heuristic_inverse(1 / own, other) == Approx(w).epsilon(1e-12));
        }
    CHECK(f64::power_heuristic(INFINITY, 3) == 1);
    CHECK(f64::power_heuristic(2, 0) == 1);
    CHECK(f64::power_heuristic_inverse(0, 3) == 1);
}

TEST_CASE("Papers: roulette survives with the throughput, at most 0.95", "[papers]") {
    // Mitsuba 3, path: q = min(max(throughput) eta^2, 0.95), weight 1 / q.
    for (double eta : {1., 1.5, 0.6})
        for (f64::vec3 t : {f64::v3(0.5, 0.2, 0.1), f64::v3(0.1, 0.6, 0.3), f64::v3(0.1, 0.2, 0.4),
                            f64::v3(3, 2, 1)}) {
            double q = std::min(0.95, std::max({t.x, t.y, t.z}) * eta * eta);
            f64::Roulette lives = russian_roulette(t, eta, q - 1e-9);
            CHECK(lives.alive);
            CHECK(lives.scale == Approx(1 / q).epsilon(1e-12));
            CHECK(!russian_roulette(t, eta, q + 1e-9).alive);
        }
}

TEST_CASE("Papers: the softened terminator, Chiang, Li and Burley 2019", "[papers]") {
    Random random(46);
    int tested = 0;
    while (tested < 1000) {
        f64::ShadingSide s;
        s.g = f64::v3(0, 0, 1);
        s.n = random.direction<F64>();
        f64::vec3 wi = random.direction<F64>();
        if (s.n.z < 0.1) continue;
        double g = wi.z / (dot3(s.n, wi) * s.n.z);
        bool lit = wi.z > 0 && dot3(s.n, wi) > 0;
        g = std::min(1.0, g);
        double expected = lit ? -g * g * g + g * g + g : 0;
        bool below = wi.z < 0 && dot3(s.n, wi) < 0;
        if (!below) REQUIRE(softened_share(s, wi) == Approx(expected).margin(1e-12));
        tested++;
    }
}
