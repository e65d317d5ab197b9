// Rough matte surfaces against the formula of the qualitative model of Oren and Nayar 1994,
// "Generalization of Lambert's reflectance model", in their angles and in double precision.
#include "host/numerics/materials.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

constexpr double pi = std::numbers::pi;

struct Angles {
    double out, in, azimuths; ///< from the normal; between the two azimuths
};

/// Radiance for an irradiance of pi on a surface that faces the light; sigma: standard deviation
/// of the facets' slope angle.
double qualitative(const Angles& w, double sigma, double rho) {
    double v = sigma * sigma, alpha = std::max(w.out, w.in), beta = std::min(w.out, w.in);
    double a = 1 - 0.5 * v / (v + 0.33), b = 0.45 * v / (v + 0.09);
    return rho * std::cos(w.in) *
           (a + b * std::max(0.0, std::cos(w.azimuths)) * std::sin(alpha) * std::tan(beta));
}

template<class P>
typename P::Vec3 direction(double angle, double azimuth) {
    return vec<P>(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                  std::cos(angle));
}

template<class P>
typename P::Material matte(double alpha) {
    MaterialCase c = material_cases()[0];
    c.kind = material_roughdiffuse;
    c.reflectance = {0.9, 0.5, 0.1};
    c.alpha_u = alpha;
    return make_material<P>(c);
}

/// The largest difference from the paper's value, of all colours.
template<class P>
double difference(double alpha, const Angles& w) {
    auto found =
        bsdf_eval(matte<P>(alpha), direction<P>(w.out, 0.7), direction<P>(w.in, 0.7 + w.azimuths));
    // Mitsuba 0.6: alpha^2 = 2 sigma^2.
    double sigma = alpha / std::numbers::sqrt2, worst = 0;
    const double rho[] = {0.9, 0.5, 0.1};
    for (int c = 0; c < 3; c++) {
        double expected = qualitative(w, sigma, rho[c]) / pi;
        worst = std::max(worst, std::fabs(component(found.f, c) - expected));
    }
    return worst;
}

template<class Check>
void for_all_angles(Check check) {
    for (double out : {0.0, 1e-3, 0.2, 0.8, 1.3, 1.57})
        for (double in : {0.0, 1e-4, 0.3, 0.8, 1.1, 1.56})
            for (double azimuths : {0.0, 0.4, pi / 2 - 0.01, pi / 2 + 0.01, 2.5, pi, 4.0})
                check(Angles{out, in, azimuths});
}

} // namespace

TEST_CASE("Papers: rough matte surfaces, Oren and Nayar 1994", "[papers]") {
    for (double alpha : {0.0, 0.05, 0.2, 0.7, 1.0, 10.0})
        for_all_angles([&](const Angles& w) {
            INFO("alpha " << alpha << ", " << w.out << " " << w.in << " " << w.azimuths);
            REQUIRE(difference<F64>(alpha, w) < 1e-12);
            REQUIRE(difference<F32>(alpha, w) < 1e-6);
        });
}

TEST_CASE("Papers: a matte surface without roughness is Lambert's", "[papers]") {
    auto smooth = matte<F64>(0);
    auto lambert = smooth;
    lambert.kind = material_diffuse;
    for_all_angles([&](const Angles& w) {
        auto wo = direction<F64>(w.out, 0), wi = direction<F64>(w.in, w.azimuths);
        auto found = bsdf_eval(smooth, wo, wi), expected = bsdf_eval(lambert, wo, wi);
        CHECK(found.f.x == Approx(expected.f.x).epsilon(1e-14));
        CHECK(found.pdf == expected.pdf);
    });
}
