// Matte bases under a smooth coat against the sum of all orders of reflection between base and
// coat, by Fresnel's formulas as textbooks have them, in double precision.
#include "host/numerics/materials.h"
#include "host/numerics/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

/// Of unpolarised light that meets an interface to the relative index eta.
double reflected(double cosine, double eta) {
    double sine_squared = (1 - cosine * cosine) / (eta * eta);
    if (sine_squared >= 1) return 1;
    double beyond = std::sqrt(1 - sine_squared);
    double s = (cosine - eta * beyond) / (cosine + eta * beyond);
    double p = (eta * cosine - beyond) / (eta * cosine + beyond);
    return (s * s + p * p) / 2;
}

/// What is sent back of light from everywhere, by the rectangle rule.
double average_reflected(double eta) {
    double sum = 0;
    constexpr int steps = 100000;
    for (int i = 0; i < steps; i++) {
        double c = (i + 0.5) / steps;
        sum += 2 * c / steps * reflected(c, eta);
    }
    return sum;
}

/// f cos(wi) of the base: light that is let in is spread by the base, and of it what is let out
/// counts, and what is not is spread again; a hundred times.
double coated(double base, double eta, bool nonlinear, double out, double in) {
    double back = average_reflected(1 / eta), sum = 0, order = base;
    for (int k = 0; k < 400; k++) {
        sum += order;
        order *= nonlinear ? base * back : back;
    }
    double let_in = 1 - reflected(in, eta), let_out = 1 - reflected(out, eta);
    return let_in * let_out / (eta * eta) * sum * in / M_PI;
}

template<class P>
typename P::Material plastic(double eta, bool nonlinear, double base) {
    MaterialCase c = material_cases()[0];
    c.kind = material_plastic;
    c.transparent = false;
    c.index = eta;
    c.reflectance = {base, base, base}, c.transmittance = {1, 1, 1};
    auto m = make_material<P>(c);
    if (nonlinear) m.kg = -m.kg;
    return m;
}

template<class P>
typename P::Vec3 direction(double cosine, double azimuth) {
    double sine = std::sqrt(1 - cosine * cosine);
    return vec<P>(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
}

} // namespace

TEMPLATE_TEST_CASE("Plastic: its base is lit by all orders of reflection from its coat", "[papers]",
                   F32, F64) {
    for (double eta : {1.0, 1.3, 1.5, 2.4})
        for (bool nonlinear : {false, true})
            for (double base : {0.1, 0.5, 0.9}) {
                auto m = plastic<TestType>(eta, nonlinear, base);
                for (double out : {0.999, 0.7, 0.2})
                    for (double in : {0.9, 0.4, 0.05}) {
                        CAPTURE(eta, nonlinear, base, out, in);
                        auto e =
                            bsdf_eval(m, direction<TestType>(out, 0.3), direction<TestType>(in, 2));
                        double expected = coated(base, eta, nonlinear, out, in);
                        CHECK(double(e.f.x) == Approx(expected).epsilon(2e-5));
                    }
            }
}

TEMPLATE_TEST_CASE("Plastic: a white base under a clear coat sends on all that it receives",
                   "[papers]", F32, F64) {
    Random random(5);
    for (double eta : {1 / 1.3, 1.05, 1.5, 3.0})
        for (double cosine : {1.0, 0.6, 0.1}) {
            auto m = plastic<TestType>(eta, false, 1);
            Mean energy;
            for (int n = 0; n < 20000; n++)
                energy.add(
                    double(bsdf_sample(m, direction<TestType>(cosine, 1), random.square<TestType>(),
                                       typename TestType::Real(random.unit()))
                               .weight.x));
            CAPTURE(eta, cosine);
            CHECK(std::abs(energy.mean() - 1) < 5 * energy.error() + 1e-5);
            CHECK(energy.error() < 0.01);
        }
}
