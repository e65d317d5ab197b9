// The chi-square test of densities notices what it should. Of every material: row `density` of the
// catalogue.
#include <catch2/catch.hpp>

#include "host/numerics/density_test.h"

using namespace parhelion;
using namespace parhelion::numerics;

// Kinds of nothing but delta lobes have no density to follow. Some have both: a coat mirrors all
// beyond the critical angle.
#define DENSITY_TEST(label, ...)                                                                   \
    TEST_CASE("Materials: a density or delta lobes, " #label, "[bsdf]") {                          \
        auto spread = configurations(material_##label, false).size(),                              \
             delta = configurations(material_##label, true).size();                                \
        CHECK((spread > 0) + (delta > 0) == (material_##label == material_plastic ? 2 : 1));       \
    }
MATERIALS(DENSITY_TEST)

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
