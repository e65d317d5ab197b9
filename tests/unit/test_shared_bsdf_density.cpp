// Every material of the list: samples follow the density that eval and sample claim (chi-square).
#include <catch2/catch.hpp>

#include "host/numerics/density_test.h"

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

void test_all(const std::vector<Configuration>& configurations, int count) {
    REQUIRE(!configurations.empty());
    double level = sidak_level(0.01, 2 * configurations.size());
    std::uint64_t seed = 1000;
    for (const Configuration& c : configurations) {
        DensityTest t = test_density(c, count, seed++);
        INFO(c.material.name << ", cosine " << c.wo.z);
        CHECK(t.integral < 1 + 1e-4);
        CHECK(t.p_value > level);
        CHECK(t.p_missing > level);
    }
}

} // namespace

// One test case a kind: they take seconds each. Kinds of nothing but delta lobes have no density to
// follow.
#define DENSITY_TEST(label, sides)                                                                 \
    TEST_CASE("Materials: samples follow the density, " #label, "[bsdf]") {                        \
        std::vector<Configuration> mine = configurations(material_##label, false);                 \
        CHECK(mine.empty() != configurations(material_##label, true).empty());                     \
        if (!mine.empty()) test_all(mine, 100000);                                                 \
    }
MATERIALS(DENSITY_TEST)

TEST_CASE("Materials: samples follow the density, a million samples", "[bsdf]") {
    std::vector<Configuration> few;
    for (int kind = 0; kind < material_kind_count; kind++)
        for (const Configuration& c : configurations(kind, false)) {
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
        if (auto s = draw(); s.pdf > 0) observed[bins.find(wide(s.wi))]++, count++;
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
