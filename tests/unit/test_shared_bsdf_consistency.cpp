// Every material of the list: sample, eval and pdf tell one story; reciprocity; energy.
#include <catch2/catch.hpp>

#include <algorithm>

#include "host/numerics/energy.h"
#include "host/numerics/materials.h"
#include "host/numerics/statistics.h"

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

/// What a rounding of wo or wi by one epsilon can change, in double: of f cos / pdf by channel, and
/// of the logarithm of the pdf. It measures how well the question is posed: the half vector of
/// opposite grazing directions is not. The larger change of both sides: at a lobe's peak the slope
/// is 0.
struct Sensitivity {
    double quotient[3] = {0, 0, 0};
    double log_pdf = 0;
};

Sensitivity sensitivity(const f64::Material& m, f64::vec3 wo, f64::vec3 wi, double epsilon) {
    const double step = 1e-7;
    Sensitivity s;
    auto here = bsdf_eval(m, wo, wi);
    auto along = [&](auto moved) {
        Sensitivity larger;
        for (double d : {step, -step}) {
            auto there = moved(d);
            if (!(here.pdf > 0 && there.pdf > 0))
                return Sensitivity{{INFINITY, INFINITY, INFINITY}, INFINITY}; // at a border
            for (int k = 0; k < 3; k++)
                larger.quotient[k] =
                    std::max(larger.quotient[k], std::fabs(component(there.f, k) / there.pdf -
                                                           component(here.f, k) / here.pdf));
            larger.log_pdf = std::max(larger.log_pdf, std::fabs(std::log(there.pdf / here.pdf)));
        }
        return larger;
    };
    auto take = [&](const Sensitivity& more) {
        for (int k = 0; k < 3; k++)
            s.quotient[k] += more.quotient[k] * (epsilon / step);
        s.log_pdf += more.log_pdf * (epsilon / step);
    };
    for (auto axis : {f64::v3(1, 0, 0), f64::v3(0, 1, 0), f64::v3(0, 0, 1)}) {
        take(
            along([&](double d) { return bsdf_eval(m, f64::add3(wo, f64::scale3(axis, d)), wi); }));
        take(
            along([&](double d) { return bsdf_eval(m, wo, f64::add3(wi, f64::scale3(axis, d))); }));
    }
    return s;
}

/// Largest deviations over all angles and samples of a material, in units of (epsilon +
/// sensitivity).
struct Deviations {
    Worst weight;  // of weight from f cos / pdf
    Worst density; // of the logarithm of sample's pdf from that of eval's
    int lost = 0, border = 0,
        samples = 0; // samples that eval does not know; those within a rounding of a border
};

template<class P>
Deviations measure(const MaterialCase& c) {
    using Real = typename P::Real;
    const double epsilon = std::numeric_limits<Real>::epsilon();
    Deviations d;
    auto m = make_material<P>(c);
    auto m64 = make_material<F64>(c);
    Random random(11);
    for (f32::vec3 w : viewer_directions(c)) {
        auto wo = vec_as<P>(w);
        // 6e-8 of length is more than a rounding there.
        if constexpr (sizeof(Real) > sizeof(float)) wo = normalize3(wo);
        for (int n = 0; n < 3000; n++) {
            auto u = random.square<P>();
            auto s = bsdf_sample(m, wo, u, Real(random.unit()));
            if (!(s.pdf > 0) || std::isinf(s.pdf)) continue;
            auto e = bsdf_eval(m, wo, s.wi);
            Sensitivity allowed = sensitivity(m64, vec_as<F64>(wo), vec_as<F64>(s.wi), epsilon);
            d.samples++;
            d.border += std::isinf(allowed.log_pdf);
            d.lost += !(e.pdf > 0) && std::isfinite(allowed.log_pdf);
            if (!(e.pdf > 0)) continue;
            for (int k = 0; k < 3; k++) {
                double weight = component(s.weight, k),
                       quotient = component(e.f, k) / double(e.pdf);
                d.weight.add(std::fabs(quotient - weight) /
                             (epsilon * weight + allowed.quotient[k] + 1e-30));
            }
            d.density.add(std::fabs(std::log(double(e.pdf) / double(s.pdf))) /
                          (epsilon + allowed.log_pdf));
        }
    }
    return d;
}

} // namespace

TEMPLATE_TEST_CASE("Materials: weight = f cos / pdf", "[bsdf]", F32, F64) {
    for (const MaterialCase& c : material_cases()) {
        Deviations d = measure<TestType>(c);
        INFO(c.name << ": " << d.samples << " samples");
        CHECK(d.lost == 0);
        CHECK(d.border <= d.samples / 1000);
        CHECK(d.weight.value() <= 8);
        CHECK(d.density.value() <= 8);
    }
}

TEMPLATE_TEST_CASE("Materials: delta lobes have no value and an infinite density", "[bsdf]", F32,
                   F64) {
    using Real = typename TestType::Real;
    Random random(12);
    int kinds = 0;
    for (const MaterialCase& c : material_cases()) {
        auto m = make_material<TestType>(c);
        for (f32::vec3 w : viewer_directions(c)) {
            auto wo = vec_as<TestType>(w);
            if (!is_delta<TestType>(m, wo)) continue;
            kinds++;
            for (int n = 0; n < 100; n++) {
                auto s = bsdf_sample(m, wo, random.square<TestType>(), Real(random.unit()));
                INFO(c.name << ", cosine " << w.z);
                CHECK(std::isinf(s.pdf));
                CHECK(double(length3(s.wi)) == Approx(1).epsilon(1e-6));
                for (auto wi : {s.wi, random.direction<TestType>()}) {
                    auto e = bsdf_eval(m, wo, wi);
                    CHECK((e.pdf == 0 && e.f.x == 0 && e.f.y == 0 && e.f.z == 0));
                }
            }
        }
    }
    CHECK(kinds > 0);
}

namespace {

/// f |cos wi| / |cos wi|, times the square of the relative index that a path from wo to wi crosses:
/// symmetric in wo and wi but for that square, which is `index`^2 one way and 1 the other. A sheet
/// has the same on both sides.
template<class M, class V>
double symmetric_value(const M& m, const MaterialCase& c, V wo, V wi, int channel) {
    bool crosses = c.kind != material_principledthin && wo.z > 0 && wi.z < 0;
    double scale = crosses ? f64::square(c.index) : 1;
    return component(bsdf_eval(m, wo, wi).f, channel) / std::fabs(double(wi.z)) * scale;
}

/// What a rounding of both directions by one epsilon can change in the logarithm of that value,
/// first order, in double.
double log_sensitivity(const f64::Material& m, const MaterialCase& c, f64::vec3 wo, f64::vec3 wi,
                       int channel) {
    const double step = 1e-7;
    double sum = 0;
    for (auto axis : {f64::v3(step, 0, 0), f64::v3(0, step, 0), f64::v3(0, 0, step)}) {
        double a = symmetric_value(m, c, wo, f64::add3(wi, axis), channel);
        double b = symmetric_value(m, c, wo, f64::sub3(wi, axis), channel);
        double d = symmetric_value(m, c, f64::add3(wo, axis), wi, channel);
        double e = symmetric_value(m, c, f64::sub3(wo, axis), wi, channel);
        if (!(a > 0 && b > 0 && d > 0 && e > 0)) return INFINITY; // at a border
        sum += (std::fabs(std::log(a / b)) + std::fabs(std::log(d / e))) / (2 * step);
    }
    return sum;
}

} // namespace

TEMPLATE_TEST_CASE(
    "Materials: reciprocity, across an interface with the square of the relative index", "[bsdf]",
    F32, F64) {
    const double epsilon = std::numeric_limits<typename TestType::Real>::epsilon();
    Random random(13);
    int reflections = 0, transmissions = 0;
    for (const MaterialCase& c : material_cases()) {
        auto m = make_material<TestType>(c);
        auto m64 = make_material<F64>(c);
        Worst worst;
        for (int n = 0; n < 20000; n++) {
            auto wo = random.direction<TestType>(), wi = random.direction<TestType>();
            int k = n % 3;
            double f = symmetric_value(m, c, wo, wi, k), g = symmetric_value(m, c, wi, wo, k);
            if (std::max(f, g) < 1e-30)
                continue; // none, or far in the tail of a sharp lobe: denormal in float
            double allowed = log_sensitivity(m64, c, vec_as<F64>(wo), vec_as<F64>(wi), k);
            // Near the critical angle the cosine beyond comes from a difference, which costs the
            // square.
            worst.add(std::fabs(f - g) / std::max(f, g) / epsilon /
                      (1 + allowed + allowed * allowed));
            (wo.z * wi.z > 0 ? reflections : transmissions)++;
        }
        INFO(c.name);
        CHECK(worst.value() <= 16);
    }
    CHECK(reflections > 1000);
    CHECK(transmissions > 1000);
}

TEST_CASE("Materials: white furnace: nothing gives more energy than it receives", "[bsdf]") {
    Random random(14);
    std::size_t means = 0;
    for (const MaterialCase& c : material_cases())
        means += 3 * viewer_directions(c).size();
    const double level = sidak_level(0.01, means);
    for (const MaterialCase& c : material_cases()) {
        auto m = make_material<F32>(c);
        const double most = most_sent_on(c);
        for (f32::vec3 wo : viewer_directions(c)) {
            Mean energy[3];
            for (int n = 0; n < 50000; n++) {
                auto s = bsdf_sample(m, wo, random.square<F32>(), float(random.unit()));
                // Radiance scaled at the interface is turned back into power.
                auto power = f32::scale3(s.weight, s.eta * s.eta);
                for (int k = 0; k < 3; k++)
                    energy[k].add(component(power, k));
            }
            INFO(c.name << ", cosine " << wo.z);
            bool exact = c.lossless && (is_delta<F32>(m, wo) || c.kind == material_diffuse);
            for (int k = 0; k < 3; k++) {
                double over = energy[k].mean() - most - 1e-6;
                if (over > 0) CHECK(normal_two_sided(over / energy[k].error()) >= level);
                if (exact) CHECK(energy[k].mean() == Approx(1).epsilon(1e-6));
                CHECK(energy[k].mean() >= 0);
            }
        }
    }
}

TEST_CASE("Materials: white furnace: compensated rough lobes give all they receive", "[bsdf]") {
    Random random(24);
    for (const MaterialCase& c : material_cases()) {
        if (!is_rough(c.kind)) continue;
        CompensatedMaterial<F32> compensated(c);
        for (f32::vec3 wo : viewer_directions(c)) {
            f32::vec3 gain = compensated.gain(wo);
            Mean energy[3];
            for (int n = 0; n < 20000; n++) {
                auto s = compensated.sample(wo, random.square<F32>(), float(random.unit()));
                auto power = f32::mul3(gain, f32::scale3(s.weight, s.eta * s.eta));
                for (int k = 0; k < 3; k++)
                    energy[k].add(component(power, k));
            }
            INFO(c.name << ", cosine " << wo.z);
            for (int k = 0; k < 3; k++) {
                CHECK(energy[k].mean() <= 1 + 3 * energy[k].error() + 3e-3);
                bool white = c.reflectance[k] == 1 && (!c.transparent || c.transmittance[k] == 1);
                if (c.lossless && white)
                    CHECK(energy[k].mean() >= 1 - 4 * energy[k].error() - 3e-3);
            }
        }
    }
}

TEST_CASE("Materials: an interface reflects and transmits in the proportion of Fresnel's formulas",
          "[bsdf]") {
    Random random(15);
    MaterialCase c = material_cases()[0];
    c.transparent = true;
    c.kind = material_dielectric;
    auto m = make_material<F32>(c);
    for (f32::vec3 wo : viewer_directions(c)) {
        f32::Fresnel f = fresnel_dielectric(std::fabs(wo.z), material_interface(m, wo.z > 0));
        CHECK(double(f.reflectance) + f.transmittance == Approx(1).epsilon(1e-6));
        const int count = 100000;
        int reflected = 0;
        for (int n = 0; n < count; n++) {
            auto s = bsdf_sample(m, wo, random.square<F32>(), float(random.unit()));
            reflected += s.wi.z * wo.z > 0;
            CHECK(s.eta == (s.wi.z * wo.z > 0 ? 1 : wo.z > 0 ? m.er : m.eg));
        }
        double r = f.reflectance, sigma = std::sqrt(std::max(r * (1 - r), 1e-9) / count);
        CHECK(std::fabs(double(reflected) / count - r) <= 4 * sigma);
    }
}

TEST_CASE("Materials: at the ends of the unit interval samples are finite with a positive density, "
          "or absent",
          "[bsdf]") {
    const float ends[] = {0, 0.5f, 1 - 0x1p-24f};
    for (const MaterialCase& c : material_cases()) {
        auto m = make_material<F32>(c);
        for (f32::vec3 wo : viewer_directions(c))
            for (float u : ends)
                for (float v : ends)
                    for (float lobe : ends) {
                        auto s = bsdf_sample(m, wo, {u, v}, lobe);
                        INFO(c.name << ", cosine " << wo.z << ", u " << u << " " << v << " "
                                    << lobe);
                        CHECK(f32::finite3(s.weight));
                        CHECK(f32::finite3(s.wi));
                        CHECK(!std::isnan(s.pdf));
                        CHECK((s.pdf > 0 || f32::max_component(s.weight) == 0));
                    }
    }
}
