// Every material of the list: samples follow the density that eval and sample claim (chi-square).
#include <catch2/catch.hpp>

#include "host/stress/direction_bins.h"
#include "host/stress/materials.h"
#include "host/stress/statistics.h"

using namespace parhelion;
using namespace parhelion::stress;

namespace {

/// What a viewing direction does to a material; delta lobes and absorbed samples are counted as
/// "elsewhere".
struct DensityTest {
    double p_value; // of the chi-square over directions
    double
        p_missing; // that the share of samples with a finite density equals the density's integral
};

DensityTest test_density(const MaterialCase& c, f32::vec3 wo, int count, std::uint64_t seed) {
    auto m = make_material<F32>(c);
    auto m64 = make_material<F64>(c);
    Random random(seed);
    auto draw = [&] { return bsdf_sample(m, wo, random.square<F32>(), float(random.unit())); };
    auto counts = [](const f32::BsdfSample& s) { return s.pdf > 0 && std::isfinite(s.pdf); };
    std::vector<f32::vec3> pilot;
    for (int n = 0; n < 16384; n++)
        if (f32::BsdfSample s = draw(); counts(s)) pilot.push_back(s.wi);
    DirectionBins bins(pilot, 64);
    std::vector<double> observed(bins.size() + 1), expected(bins.size() + 1);
    for (int n = 0; n < count; n++) {
        f32::BsdfSample s = draw();
        observed[counts(s) ? bins.find(s.wi) : bins.size()]++;
    }
    double scattered = 0;
    auto density = [&](f64::vec3 wi) { return bsdf_eval(m64, wide(wo), wi).pdf; };
    // Opposite grazing directions have half vectors that turn within a ridge as narrow as the
    // viewer's height.
    int certain = std::fabs(wo.z) < 0.05 ? 6 : 9;
    for (std::size_t i = 0; i < bins.size(); i++) {
        double mass = bins.mass(i, density, 0.1 / count, certain);
        expected[i] = count * mass;
        scattered += mass;
    }
    INFO(c.name << ", cosine " << wo.z);
    CHECK(scattered < 1 + 1e-4);
    expected[bins.size()] = count * std::max(0.0, 1 - scattered);
    // The integral itself: normal approximation of the binomial, and the quadrature's own error.
    double missing = observed[bins.size()] / count;
    double sigma = std::sqrt(std::max(missing, 1.0 / count) / count) + 1e-5;
    return {chi_square_p(observed, expected),
            normal_two_sided((missing - (1 - scattered)) / sigma)};
}

struct Configuration {
    MaterialCase material;
    f32::vec3 wo;
};

std::vector<Configuration> smooth_configurations() {
    std::vector<Configuration> all;
    for (const MaterialCase& c : material_cases())
        for (f32::vec3 wo : viewer_directions(c))
            if (!is_delta<F32>(make_material<F32>(c), wo)) all.push_back({c, wo});
    return all;
}

void test_all(const std::vector<Configuration>& configurations, int count) {
    REQUIRE(!configurations.empty());
    double level = sidak_level(0.01, 2 * configurations.size());
    std::uint64_t seed = 1000;
    for (const Configuration& c : configurations) {
        DensityTest t = test_density(c.material, c.wo, count, seed++);
        INFO(c.material.name << ", cosine " << c.wo.z);
        CHECK(t.p_value > level);
        CHECK(t.p_missing > level);
    }
}

} // namespace

// One test case a kind: they take seconds each. Kinds of nothing but delta lobes have no density to
// follow.
#define DENSITY_TEST(label, sides)                                                                 \
    TEST_CASE("Materials: samples follow the density, " #label, "[bsdf]") {                        \
        std::vector<Configuration> mine;                                                           \
        int delta = 0;                                                                             \
        for (const MaterialCase& c : material_cases())                                             \
            for (f32::vec3 wo : viewer_directions(c))                                              \
                if (c.kind == material_##label) delta += is_delta<F32>(make_material<F32>(c), wo); \
        for (const Configuration& c : smooth_configurations())                                     \
            if (c.material.kind == material_##label) mine.push_back(c);                            \
        CHECK(mine.empty() != (delta == 0));                                                       \
        if (!mine.empty()) test_all(mine, 100000);                                                 \
    }
MATERIALS(DENSITY_TEST)

TEST_CASE("Materials: samples follow the density, a million samples", "[bsdf]") {
    std::vector<Configuration> few;
    for (const Configuration& c : smooth_configurations()) {
        double cosine = std::fabs(c.wo.z);
        if (c.material.alpha_u != c.material.alpha_v && cosine > 0.4 && cosine < 0.6)
            few.push_back(c);
    }
    test_all(few, 1000000);
}

TEST_CASE("Materials: the density test notices a roughness that is off by three percent",
          "[bsdf]") {
    MaterialCase c = material_cases()[0];
    c.kind = material_roughconductor;
    c.transparent = false;
    MaterialCase wrong = c;
    wrong.alpha_u = wrong.alpha_v = c.alpha_u * 1.03;
    f32::vec3 wo = f32::v3(0.6f, 0, 0.8f);
    Random random(7);
    auto m = make_material<F32>(c);
    auto draw = [&] { return bsdf_sample(m, wo, random.square<F32>(), float(random.unit())); };
    std::vector<f32::vec3> pilot;
    for (int n = 0; n < 8192; n++)
        if (auto s = draw(); s.pdf > 0) pilot.push_back(s.wi);
    DirectionBins bins(pilot, 64);
    std::vector<double> observed(bins.size()), expected(bins.size());
    int count = 0;
    for (int n = 0; n < 1000000; n++)
        if (auto s = draw(); s.pdf > 0) observed[bins.find(s.wi)]++, count++;
    auto density = [m64 = make_material<F64>(wrong), wo](f64::vec3 wi) {
        return bsdf_eval(m64, wide(wo), wi).pdf;
    };
    double total = 0;
    for (std::size_t i = 0; i < bins.size(); i++)
        total += expected[i] = bins.mass(i, density, 1e-7);
    for (double& e : expected)
        e *= count / total;
    CHECK(chi_square_p(observed, expected) < 1e-6);
}
