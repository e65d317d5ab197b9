// Matte bases under a rough coat against what Mitsuba 3.9.1 says of them: `eval` of its
// roughplastic at directions of the given cosines and azimuths.
#include "host/numerics/energy.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <span>
#include <vector>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

struct Figure {
    int distribution; // 0: GGX
    double alpha;
    bool nonlinear;
    double base, index, out, in, azimuth; ///< cosines
    double value;                         ///< f cos; specular reflectance 0.7
};

// clang-format off
constexpr Figure figures[] = {
        {0, 0.05, false, 0.5, 1.49, 1, 0.8, 1, 0.123193},
        {0, 0.05, false, 0.5, 1.49, 0.7, 0.5, 3, 0.0895901},
        {0, 0.05, false, 0.5, 1.49, 0.5, 0.9, 0.5, 0.131309},
        {0, 0.05, false, 0.5, 1.49, 0.35, 0.3, 3.1, 1.5735},
        {0, 0.05, false, 0.9, 2, 1, 0.8, 1, 0.196413},
        {0, 0.05, false, 0.9, 2, 0.7, 0.5, 3, 0.152331},
        {0, 0.05, false, 0.9, 2, 0.5, 0.9, 0.5, 0.207723},
        {0, 0.05, false, 0.9, 2, 0.35, 0.3, 3.1, 2.14623},
        {0, 0.05, true, 0.5, 1.49, 1, 0.8, 1, 0.0742893},
        {0, 0.05, true, 0.5, 1.49, 0.7, 0.5, 3, 0.060846},
        {0, 0.05, true, 0.5, 1.49, 0.5, 0.9, 0.5, 0.0789849},
        {0, 0.05, true, 0.5, 1.49, 0.35, 0.3, 3.1, 1.56016},
        {0, 0.05, true, 0.9, 2, 1, 0.8, 1, 0.147702},
        {0, 0.05, true, 0.9, 2, 0.7, 0.5, 3, 0.123899},
        {0, 0.05, true, 0.9, 2, 0.5, 0.9, 0.5, 0.155853},
        {0, 0.05, true, 0.9, 2, 0.35, 0.3, 3.1, 2.13305},
        {0, 0.3, false, 0.5, 1.49, 1, 0.8, 1, 0.0930016},
        {0, 0.3, false, 0.5, 1.49, 0.7, 0.5, 3, 0.0824516},
        {0, 0.3, false, 0.5, 1.49, 0.5, 0.9, 0.5, 0.0934613},
        {0, 0.3, false, 0.5, 1.49, 0.35, 0.3, 3.1, 0.242781},
        {0, 0.3, false, 0.9, 2, 1, 0.8, 1, 0.129376},
        {0, 0.3, false, 0.9, 2, 0.7, 0.5, 3, 0.136331},
        {0, 0.3, false, 0.9, 2, 0.5, 0.9, 0.5, 0.123292},
        {0, 0.3, false, 0.9, 2, 0.35, 0.3, 3.1, 0.328826},
        {0, 0.3, true, 0.5, 1.49, 1, 0.8, 1, 0.0706049},
        {0, 0.3, true, 0.5, 1.49, 0.7, 0.5, 3, 0.0696024},
        {0, 0.3, true, 0.5, 1.49, 0.5, 0.9, 0.5, 0.0698112},
        {0, 0.3, true, 0.5, 1.49, 0.35, 0.3, 3.1, 0.236352},
        {0, 0.3, true, 0.9, 2, 1, 0.8, 1, 0.114146},
        {0, 0.3, true, 0.9, 2, 0.7, 0.5, 3, 0.12757},
        {0, 0.3, true, 0.9, 2, 0.5, 0.9, 0.5, 0.107175},
        {0, 0.3, true, 0.9, 2, 0.35, 0.3, 3.1, 0.324388},
        {0, 0.8, false, 0.5, 1.49, 1, 0.8, 1, 0.0563053},
        {0, 0.8, false, 0.5, 1.49, 0.7, 0.5, 3, 0.0305268},
        {0, 0.8, false, 0.5, 1.49, 0.5, 0.9, 0.5, 0.0531364},
        {0, 0.8, false, 0.5, 1.49, 0.35, 0.3, 3.1, 0.0245038},
        {0, 0.8, false, 0.9, 2, 1, 0.8, 1, 0.0604453},
        {0, 0.8, false, 0.9, 2, 0.7, 0.5, 3, 0.0364702},
        {0, 0.8, false, 0.9, 2, 0.5, 0.9, 0.5, 0.0588202},
        {0, 0.8, false, 0.9, 2, 0.35, 0.3, 3.1, 0.0304983},
        {0, 0.8, true, 0.5, 1.49, 1, 0.8, 1, 0.0515438},
        {0, 0.8, true, 0.5, 1.49, 0.7, 0.5, 3, 0.0282385},
        {0, 0.8, true, 0.5, 1.49, 0.5, 0.9, 0.5, 0.0486813},
        {0, 0.8, true, 0.5, 1.49, 0.35, 0.3, 3.1, 0.0236028},
        {0, 0.8, true, 0.9, 2, 1, 0.8, 1, 0.0583248},
        {0, 0.8, true, 0.9, 2, 0.7, 0.5, 3, 0.0354246},
        {0, 0.8, true, 0.9, 2, 0.5, 0.9, 0.5, 0.056797},
        {0, 0.8, true, 0.9, 2, 0.35, 0.3, 3.1, 0.0300553},
        {1, 0.05, false, 0.5, 1.49, 1, 0.8, 1, 0.125632},
        {1, 0.05, false, 0.5, 1.49, 0.7, 0.5, 3, 0.0740548},
        {1, 0.05, false, 0.5, 1.49, 0.5, 0.9, 0.5, 0.134527},
        {1, 0.05, false, 0.5, 1.49, 0.35, 0.3, 3.1, 2.08352},
        {1, 0.05, false, 0.9, 2, 1, 0.8, 1, 0.202906},
        {1, 0.05, false, 0.9, 2, 0.7, 0.5, 3, 0.11878},
        {1, 0.05, false, 0.9, 2, 0.5, 0.9, 0.5, 0.216154},
        {1, 0.05, false, 0.9, 2, 0.35, 0.3, 3.1, 2.84049},
        {1, 0.05, true, 0.5, 1.49, 1, 0.8, 1, 0.0743284},
        {1, 0.05, true, 0.5, 1.49, 0.7, 0.5, 3, 0.043858},
        {1, 0.05, true, 0.5, 1.49, 0.5, 0.9, 0.5, 0.0795907},
        {1, 0.05, true, 0.5, 1.49, 0.35, 0.3, 3.1, 2.06962},
        {1, 0.05, true, 0.9, 2, 1, 0.8, 1, 0.150235},
        {1, 0.05, true, 0.9, 2, 0.7, 0.5, 3, 0.0880091},
        {1, 0.05, true, 0.9, 2, 0.5, 0.9, 0.5, 0.160044},
        {1, 0.05, true, 0.9, 2, 0.35, 0.3, 3.1, 2.82635},
        {1, 0.3, false, 0.5, 1.49, 1, 0.8, 1, 0.118971},
        {1, 0.3, false, 0.5, 1.49, 0.7, 0.5, 3, 0.107687},
        {1, 0.3, false, 0.5, 1.49, 0.5, 0.9, 0.5, 0.117279},
        {1, 0.3, false, 0.5, 1.49, 0.35, 0.3, 3.1, 0.334349},
        {1, 0.3, false, 0.9, 2, 1, 0.8, 1, 0.190997},
        {1, 0.3, false, 0.9, 2, 0.7, 0.5, 3, 0.19219},
        {1, 0.3, false, 0.9, 2, 0.5, 0.9, 0.5, 0.176182},
        {1, 0.3, false, 0.9, 2, 0.35, 0.3, 3.1, 0.45892},
        {1, 0.3, true, 0.5, 1.49, 1, 0.8, 1, 0.0798374},
        {1, 0.3, true, 0.5, 1.49, 0.7, 0.5, 3, 0.0849454},
        {1, 0.3, true, 0.5, 1.49, 0.5, 0.9, 0.5, 0.075683},
        {1, 0.3, true, 0.5, 1.49, 0.35, 0.3, 3.1, 0.323027},
        {1, 0.3, true, 0.9, 2, 1, 0.8, 1, 0.155554},
        {1, 0.3, true, 0.9, 2, 0.7, 0.5, 3, 0.171701},
        {1, 0.3, true, 0.9, 2, 0.5, 0.9, 0.5, 0.138631},
        {1, 0.3, true, 0.9, 2, 0.35, 0.3, 3.1, 0.448728},
        {1, 0.8, false, 0.5, 1.49, 1, 0.8, 1, 0.0765692},
        {1, 0.8, false, 0.5, 1.49, 0.7, 0.5, 3, 0.0496055},
        {1, 0.8, false, 0.5, 1.49, 0.5, 0.9, 0.5, 0.0838138},
        {1, 0.8, false, 0.5, 1.49, 0.35, 0.3, 3.1, 0.0500028},
        {1, 0.8, false, 0.9, 2, 1, 0.8, 1, 0.0982233},
        {1, 0.8, false, 0.9, 2, 0.7, 0.5, 3, 0.0672752},
        {1, 0.8, false, 0.9, 2, 0.5, 0.9, 0.5, 0.111295},
        {1, 0.8, false, 0.9, 2, 0.35, 0.3, 3.1, 0.0659102},
        {1, 0.8, true, 0.5, 1.49, 1, 0.8, 1, 0.0637074},
        {1, 0.8, true, 0.5, 1.49, 0.7, 0.5, 3, 0.0421263},
        {1, 0.8, true, 0.5, 1.49, 0.5, 0.9, 0.5, 0.0700748},
        {1, 0.8, true, 0.5, 1.49, 0.35, 0.3, 3.1, 0.0460804},
        {1, 0.8, true, 0.9, 2, 1, 0.8, 1, 0.0900357},
        {1, 0.8, true, 0.9, 2, 0.7, 0.5, 3, 0.0624864},
        {1, 0.8, true, 0.9, 2, 0.5, 0.9, 0.5, 0.102494},
        {1, 0.8, true, 0.9, 2, 0.35, 0.3, 3.1, 0.0632891},
};
// clang-format on

template<class P>
typename P::Vec3 direction(double cosine, double azimuth) {
    double sine = std::sqrt(1 - cosine * cosine);
    return vec<P>(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
}

/// Of the materials' own numbers, without compensation, the tables among them.
double found(const Figure& f) {
    RoughPlasticBsdf b{
        {f.distribution ? MicrofacetDistribution::beckmann : MicrofacetDistribution::ggx, f.alpha},
        f.index,
        Rgb(f.base),
        Rgb(0.7),
        f.nonlinear,
        false};
    MaterialRecord record = material_record(b);
    std::vector<float> tables = energy_tables(record, ENERGY_AZIMUTHS, false);
    auto row = std::span(tables).last(ENERGY_COSINES);
    record.kg = std::copysign(float(coat_inner_reflectance(record, row, false)), record.kg);
    record.distribution |= 1 << 1;
    f64::Material m{};
#define COPY_FIELD(type, name) m.name = record.name;
    MATERIAL_FIELDS(COPY_FIELD)
#undef COPY_FIELD
    f64::vec3 wo = direction<F64>(f.out, 0), wi = direction<F64>(f.in, f.azimuth);
    return bsdf_eval(coated(tables, m, wo, wi), wo, wi).f.x;
}

} // namespace

TEST_CASE("Rough plastic: without compensation it is Mitsuba's", "[papers]") {
    for (const Figure& f : figures) {
        CAPTURE(f.distribution, f.alpha, f.nonlinear, f.base, f.index, f.out, f.in);
        // Mitsuba's integral over Beckmann's normals, 32 x 32 of them, is off by as much.
        CHECK(found(f) == Approx(f.value).epsilon(f.distribution ? 3e-3 : 1e-3));
    }
}
