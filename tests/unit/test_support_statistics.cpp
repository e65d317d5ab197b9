// The tests' own statistics: known values, and proof that a wrong density is found out.
#include <catch2/catch.hpp>

#include "host/numerics/direction_bins.h"
#include "host/numerics/quadrature.h"
#include "host/numerics/statistics.h"

using namespace parhelion;
using namespace parhelion::numerics;

TEST_CASE("Statistics: chi-square tail, normal tail and Sidak bound have their known values",
          "[support]") {
    CHECK(chi_square_tail(18.307, 10) == Approx(0.05).epsilon(1e-4));
    CHECK(chi_square_tail(124.342, 100) == Approx(0.05).epsilon(1e-4));
    CHECK(chi_square_tail(0.0039321, 1) == Approx(0.95).epsilon(1e-4));
    CHECK(normal_two_sided(1.959964) == Approx(0.05).epsilon(1e-5));
    CHECK(sidak_level(0.05, 1) == Approx(0.05));
    CHECK(std::pow(1 - sidak_level(0.01, 50), 50) == Approx(0.99));
}

TEST_CASE("Statistics: chi-square accepts the right counts and rejects wrong ones", "[support]") {
    CHECK(chi_square_p({100, 102, 97, 101}, {100, 100, 100, 100}) > 0.5);
    CHECK(chi_square_p({150, 50, 100, 100}, {100, 100, 100, 100}) < 1e-6);
    CHECK(chi_square_p({90, 90, 60}, {120, 120, 0}) < 1e-6);
}

TEST_CASE("Statistics: quadrature of a sharp peak with a cut-off", "[support]") {
    auto peak = [](double x, double y) { return y < 0.3 ? 0 : std::exp(-(x * x + y * y) / 0.02); };
    double truth =
        M_PI * 0.02 / 4 * std::erfc(0.3 / std::sqrt(0.02)) * std::erf(1 / std::sqrt(0.02));
    CHECK(integrate(peak, {0, 1, 0, 1}, 1e-11) == Approx(truth).epsilon(1e-3));
}

namespace {
// Cosine-distributed directions, binned and held against the density claimed_power / pi *
// z^claimed_power.
double cosine_p_value(double claimed_power) {
    Random random(5);
    std::vector<f32::vec3> pilot;
    pilot.reserve(8192);
    for (int n = 0; n < 8192; n++)
        pilot.push_back(f32::hemisphere_cosine(random.square<F32>()));
    DirectionBins bins(pilot, 64);
    const int count = 200000;
    std::vector<double> observed(bins.size()), expected(bins.size());
    for (int n = 0; n < count; n++)
        observed[bins.find(wide(f32::hemisphere_cosine(random.square<F32>())))]++;
    auto density = [&](f64::vec3 w) {
        return w.z > 0 ? std::pow(w.z, claimed_power) * (claimed_power + 1) / (2 * M_PI) : 0;
    };
    for (std::size_t i = 0; i < bins.size(); i++)
        expected[i] = count * bins.mass(i, density, 1e-7);
    return chi_square_p(observed, expected);
}
} // namespace

TEST_CASE("Statistics: direction bins find a density that is off by five percent in its exponent",
          "[support]") {
    CHECK(cosine_p_value(1) > 0.01);
    CHECK(cosine_p_value(1.05) < 1e-4);
}

TEST_CASE("Statistics: Kolmogorov and Smirnov's test accepts even numbers and refuses uneven ones",
          "[support]") {
    Random random(6);
    std::vector<double> even, uneven, p_values;
    for (int n = 0; n < 1000; n++) {
        even.push_back(random.unit());
        uneven.push_back(std::pow(random.unit(), 1.2));
    }
    CHECK(kolmogorov_smirnov_p(even) > 0.01);
    CHECK(kolmogorov_smirnov_p(uneven) < 1e-4);
    for (int n = 0; n < 400; n++) {
        std::vector<double> values(50);
        for (double& v : values)
            v = random.unit();
        p_values.push_back(kolmogorov_smirnov_p(values));
    }
    CHECK(kolmogorov_smirnov_p(p_values) > 0.01); // its own p-values are even too
}
