// Microfacet lobes against the formulas as their papers print them, in angles and in double:
//
//   Walter, Marschner, Li and Torrance 2007, "Microfacet models for refraction through rough
//   surfaces"; Heitz 2014, "Understanding the masking-shadowing function in microfacet-based
//   BRDFs".
//
// `i` is the direction of the light, `o` that of the viewer, as in Walter et al.
#include "host/numerics/measure.h"

#include "host/numerics/materials.h"

#include <catch2/catch.hpp>

#include <complex>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

constexpr double pi = 3.14159265358979323846;

double cosine(f64::vec3 a, f64::vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double tangent(f64::vec3 w) { return std::hypot(w.x, w.y) / std::fabs(w.z); }

struct Roughness {
    bool beckmann;
    double x, y;
};

/// The roughness in the plane of w and the normal: Heitz 2014, equation 80.
double roughness_along(f64::vec3 w, Roughness r) {
    double phi = std::atan2(w.y, w.x);
    return std::sqrt(std::pow(std::cos(phi) * r.x, 2) + std::pow(std::sin(phi) * r.y, 2));
}

/// Distribution of normals: Walter 25 and 33 where both roughnesses are the same, else Heitz 83 and
/// 85.
double distribution(f64::vec3 m, Roughness r) {
    double theta = std::atan(tangent(m)), phi = std::atan2(m.y, m.x);
    double cos4 = std::pow(std::cos(theta), 4);
    if (r.x == r.y) {
        double a2 = r.x * r.x, tan2 = std::pow(std::tan(theta), 2);
        return r.beckmann ? std::exp(-tan2 / a2) / (pi * a2 * cos4)
                          : a2 / (pi * cos4 * std::pow(a2 + tan2, 2));
    }
    double slope = std::pow(std::tan(theta), 2) *
                   (std::pow(std::cos(phi) / r.x, 2) + std::pow(std::sin(phi) / r.y, 2));
    return r.beckmann ? std::exp(-slope) / (pi * r.x * r.y * cos4)
                      : 1 / (pi * r.x * r.y * cos4 * std::pow(1 + slope, 2));
}

/// Smith's masking. GGX: Heitz 43 and 72, G1 = 1/(1 + Lambda). Beckmann: Walter's approximation,
/// equation 27.
double masking(f64::vec3 w, Roughness r) {
    double a = 1 / (roughness_along(w, r) * tangent(w));
    if (!r.beckmann) return 1 / (1 + (std::sqrt(1 + 1 / (a * a)) - 1) / 2);
    return a < 1.6 ? (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a) : 1;
}

/// Beckmann's masking without approximation: Walter 26.
double exact_beckmann_masking(f64::vec3 w, Roughness r) {
    double a = 1 / (roughness_along(w, r) * tangent(w));
    return 2 / (1 + std::erf(a) + std::exp(-a * a) / (a * std::sqrt(pi)));
}

/// The masking in the density of visible normals, Heitz and d'Eon 2014, equation 2: exact.
double masking_of_visible(f64::vec3 w, Roughness r) {
    return r.beckmann ? exact_beckmann_masking(w, r) : masking(w, r);
}

/// Fresnel's equations for a complex index and the cosine of incidence (Born and Wolf, section
/// 14.2), unpolarised.
double metal_reflectance(double c, std::complex<double> n) {
    std::complex<double> t = std::sqrt(1. - (1 - c * c) / (n * n));
    std::complex<double> s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    return (std::norm(s) + std::norm(p)) / 2;
}

/// Walter 22, for the index n_t / n_i.
double glass_reflectance(double c, double n) {
    double g2 = n * n - 1 + c * c;
    if (g2 <= 0) return 1;
    double g = std::sqrt(g2), q = (c * (g + c) - 1) / (c * (g - c) + 1);
    return 0.5 * std::pow((g - c) / (g + c), 2) * (1 + q * q);
}

std::vector<Roughness> roughnesses() {
    std::vector<Roughness> all;
    for (bool beckmann : {false, true})
        for (auto [x, y] : {std::pair{0.3, 0.3}, {0.08, 0.08}, {0.9, 0.9}, {0.15, 0.6}, {0.7, 0.2}})
            all.push_back({beckmann, x, y});
    return all;
}

template<class P>
typename P::Material material(int kind, Roughness r, double index = 1.5) {
    MaterialCase c{"",
                   kind,
                   kind == material_roughdielectric,
                   true,
                   {0.9, 0.7, 0.5},
                   {0.8, 0.6, 0.4},
                   {0.2, 0.9, 1.5},
                   {3.9, 2.4, 1.8},
                   index,
                   r.x,
                   r.y,
                   r.beckmann ? 1 : 0};
    return make_material<P>(c);
}

/// A direction at least `least` high.
f64::vec3 upper_direction(Random& random, double least = 0.05) {
    for (;;)
        if (auto w = random.direction<F64>(); std::fabs(w.z) > least)
            return {w.x, w.y, std::fabs(w.z)};
}

} // namespace

TEST_CASE("Papers: distributions of normals and Smith's masking", "[papers]") {
    Random random(41);
    for (Roughness r : roughnesses()) {
        INFO("Beckmann " << r.beckmann << ", " << r.x << " x " << r.y);
        for (int n = 0; n < 500; n++) {
            f64::vec3 h = upper_direction(random, 0.2), w = upper_direction(random);
            auto m = material<F64>(material_roughconductor, r);
            double d = distribution(h, r), g = masking(w, r);
            REQUIRE(microfacet_g1(m, w) == Approx(g).epsilon(1e-10).margin(1e-20));
            REQUIRE(microfacet_visible_d(m, w, h) ==
                    Approx(g * d / w.z).epsilon(1e-9).margin(1e-20));
            // What normals are chosen by: Heitz 16.
            REQUIRE(microfacet_sample_visible_d(m, w, h) ==
                    Approx(masking_of_visible(w, r) * d / w.z).epsilon(1e-9).margin(1e-20));
            if (r.beckmann) {
                double alone = f64::beckmann_d(h, r.x, r.y);
                REQUIRE(alone == Approx(d).epsilon(1e-9).margin(1e-20));
                REQUIRE(g == Approx(exact_beckmann_masking(w, r)).epsilon(0.0036));
            } else {
                REQUIRE(f64::ggx_d(h, r.x, r.y) == Approx(d).epsilon(1e-9).margin(1e-20));
            }
        }
    }
}

TEST_CASE("Papers: rough metal, Walter 20", "[papers]") {
    Random random(42);
    for (Roughness r : roughnesses())
        for (int n = 0; n < 500; n++) {
            f64::vec3 o = upper_direction(random), i = upper_direction(random);
            f64::vec3 h = f64::normalize3(f64::add3(i, o));
            auto m = material<F64>(material_roughconductor, r);
            f64::BsdfEval found = bsdf_eval(m, o, i);
            double dg = distribution(h, r) * masking(i, r) * masking(o, r);
            double common = dg / (4 * i.z * o.z) * i.z;
            REQUIRE(found.f.x == Approx(common * 0.9 * metal_reflectance(cosine(i, h), {0.2, 3.9}))
                                     .epsilon(1e-8)
                                     .margin(1e-20));
            REQUIRE(found.f.y == Approx(common * 0.7 * metal_reflectance(cosine(i, h), {0.9, 2.4}))
                                     .epsilon(1e-8)
                                     .margin(1e-20));
            REQUIRE(found.f.z == Approx(common * 0.5 * metal_reflectance(cosine(i, h), {1.5, 1.8}))
                                     .epsilon(1e-8)
                                     .margin(1e-20));
            // Walter 14 (the Jacobian of reflection) of the density of visible normals.
            double density = distribution(h, r) * masking_of_visible(o, r) * cosine(o, h) / o.z /
                             (4 * cosine(o, h));
            REQUIRE(found.pdf == Approx(density).epsilon(1e-8).margin(1e-20));
        }
}

TEST_CASE("Papers: rough glass, Walter 20 and 21, from both sides", "[papers]") {
    Random random(43);
    int reflected = 0, transmitted = 0;
    for (Roughness r : roughnesses())
        for (int n = 0; n < 2000; n++) {
            double index = n % 2 ? 1.5 : 1 / 1.33;
            f64::vec3 o = random.direction<F64>(), i = random.direction<F64>();
            if (std::fabs(o.z) < 0.05 || std::fabs(i.z) < 0.05) continue;
            // Indices on the viewer's side and on the light's.
            double no = o.z > 0 ? 1 : index, ni = i.z > 0 ? 1 : index;
            bool reflects = o.z * i.z > 0;
            double side = o.z > 0 ? 1 : -1;
            f64::vec3 h = f64::normalize3(
                reflects ? f64::scale3(f64::add3(i, o), side)
                         : f64::neg3(f64::add3(f64::scale3(i, ni), f64::scale3(o, no))));
            if (h.z < 0) h = f64::neg3(h); // Walter's normals are those of the macrosurface's side
            auto m = material<F64>(material_roughdielectric, r, index);
            f64::BsdfEval found = bsdf_eval(m, o, i);
            double ih = cosine(i, h), oh = cosine(o, h);
            // Both have to see the right side of the microsurface.
            if (oh * o.z <= 0 || ih * i.z <= 0) {
                REQUIRE(found.f.x == 0);
                REQUIRE(found.pdf == 0);
                continue;
            }
            double dg = distribution(h, r) * masking(i, r) * masking(o, r);
            double other = reflects ? (o.z > 0 ? index : 1 / index) : ni / no;
            double f = glass_reflectance(std::fabs(oh), other);
            double bent = std::pow(ni * ih + no * oh, 2);
            double value = reflects
                               ? f * dg / (4 * std::fabs(i.z * o.z))
                               : std::fabs(ih * oh / (i.z * o.z)) * no * no * (1 - f) * dg / bent;
            REQUIRE(found.f.x == Approx(value * std::fabs(i.z) * (reflects ? 0.9 : 0.8))
                                     .epsilon(1e-7)
                                     .margin(1e-20));
            REQUIRE(found.f.z == Approx(value * std::fabs(i.z) * (reflects ? 0.5 : 0.4))
                                     .epsilon(1e-7)
                                     .margin(1e-20));
            // Walter 14 and 17: Jacobians of reflection and refraction.
            double jacobian = reflects ? 1 / (4 * std::fabs(oh)) : ni * ni * std::fabs(ih) / bent;
            double normals = distribution(h, r) * masking_of_visible(o, r) * std::fabs(oh / o.z);
            REQUIRE(
                found.pdf ==
                Approx((reflects ? f : 1 - f) * normals * jacobian).epsilon(1e-7).margin(1e-20));
            (reflects ? reflected : transmitted)++;
        }
    CHECK(reflected > 3000);
    CHECK(transmitted > 1000);
}
