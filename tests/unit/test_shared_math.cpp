// The elementary functions, frames and microfacet densities in float against double or long double.
#include <catch2/catch.hpp>

#include "host/numerics/materials.h"

using namespace parhelion;
using namespace parhelion::numerics;

TEST_CASE("Maths: sine and cosine of turns within 1.2e-7", "[maths]") {
    Worst worst;
    for (int n = 0; n <= 1 << 20; n++) {
        float u = float(n) * 0x1p-20f;
        f32::SinCos s = f32::sincos_turns(u);
        worst.add(std::max(std::fabs(s.sine - std::sin(2 * M_PI * double(u))),
                           std::fabs(s.cosine - std::cos(2 * M_PI * double(u)))));
    }
    CHECK(worst.value() <= 1.2e-7);
}

TEST_CASE("Maths: exp of a negative number within 2e-7, zero from -87.3 down", "[maths]") {
    Random random(41);
    Worst worst;
    for (int n = 0; n < 1000000; n++) {
        float x = -float(random.log_between(1e-10, 87.2));
        worst.add(std::fabs(double(f32::exp_negative(x)) / std::exp(double(x)) - 1));
    }
    CHECK(worst.value() <= 2e-7);
    CHECK(f32::exp_negative(0) == 1);
    CHECK(f32::exp_negative(-88) == 0);
    CHECK(f32::exp_negative(-1e30f) == 0);
    CHECK(f32::exp_negative(-INFINITY) == 0);
}

TEST_CASE("Maths: atan2 within 3e-7 in all quadrants, acos within 4e-7", "[maths]") {
    Random random(42);
    Worst atan2_error, acos_error;
    for (int n = 0; n < 1000000; n++) {
        float y = float(random.sign() * random.log_between(1e-6, 1e6));
        float x = float(random.sign() * random.log_between(1e-6, 1e6));
        atan2_error.add(std::fabs(f32::atan2R(y, x) - std::atan2(double(y), double(x))));
        float c = float(random.between(-1, 1));
        acos_error.add(std::fabs(f32::acosR(c) - std::acos(double(c))));
    }
    CHECK(atan2_error.value() <= 3e-7);
    CHECK(acos_error.value() <= 4e-7);
    CHECK(f32::atan2R(0, 0) == 0);
    CHECK(f32::atan2R(0, 1) == 0);
    CHECK(f32::atan2R(0, -1) == Approx(M_PI));
    CHECK(f32::atan2R(-1, 0) == Approx(-M_PI / 2));
    CHECK(f32::acosR(1) == 0);
    CHECK(f32::acosR(-1) == Approx(M_PI));
    // acos keeps its digits near 1, where the angle is small.
    CHECK(f32::acosR(1 - 0x1p-22f) == Approx(std::acos(1 - 0x1p-22)).epsilon(1e-6));
}

TEST_CASE("Maths: difference of products within 1.5 ulp, its sign exact", "[maths]") {
    Random random(43);
    Worst worst;
    for (int n = 0; n < 1000000; n++) {
        float a = float(random.between(-1, 1)), b = float(random.between(-1, 1)),
              c = float(random.between(-1, 1));
        float d = n % 2 ? float(random.between(-1, 1))
                        : a * b / c * float(1 + random.between(-1e-6, 1e-6));
        float value = f32::difference_of_products(a, b, c, d);
        worst.add(ulps(value, (long double)((__float128)a * b - (__float128)c * d)));
        __float128 exact = (__float128)a * b - (__float128)c * d;
        if ((value > 0) != (exact > 0) || (value < 0) != (exact < 0)) FAIL("wrong sign");
    }
    CHECK(worst.value() <= 1.5);
    CHECK(f32::difference_of_products(0.1f, 0.3f, 0.3f, 0.1f) == 0);
}

TEST_CASE("Frames: axes about any normal are orthogonal within 2e-7 and of unit length",
          "[maths]") {
    Random random(44);
    Worst dots, lengths;
    for (int n = 0; n < 1000000; n++) {
        f32::vec3 normal = random.direction<F32>();
        if (n % 4 == 0) { // close to the poles, where other bases break
            double x = random.between(-1e-3, 1e-3), y = random.between(-1e-3, 1e-3);
            normal = vec<F32>(x, y, random.sign() * std::sqrt(1 - x * x - y * y));
        }
        f32::ShadingFrame f = f32::frame_from_normal(normal);
        f64::vec3 s = wide(f.s), t = wide(f.t), w = wide(f.n);
        dots.add(std::max(
            {std::fabs(f64::dot3(s, t)), std::fabs(f64::dot3(s, w)), std::fabs(f64::dot3(t, w))}));
        lengths.add(std::max(std::fabs(f64::length3(s) - 1), std::fabs(f64::length3(t) - 1)));
        if (f64::dot3(f64::cross3(s, t), w) < 0.999) FAIL("left-handed");
    }
    CHECK(dots.value() <= 2e-7);
    CHECK(lengths.value() <= 3e-7);
    CHECK(f32::frame_from_normal(f32::v3(0, 0, -1)).s.x == 1);
}

TEST_CASE("Frames: s follows the tangent", "[maths]") {
    Random random(45);
    for (int n = 0; n < 10000; n++) {
        f32::vec3 normal = random.direction<F32>();
        f32::vec3 tangent =
            f32::scale3(random.direction<F32>(), float(random.log_between(1e-3, 1e3)));
        double sine =
            f64::length3(f64::cross3(wide(normal), wide(tangent))) / f64::length3(wide(tangent));
        if (sine < 0.1) continue; // a tangent along the normal has no direction across it
        f32::ShadingFrame f = f32::frame_from_tangent(normal, tangent);
        CHECK(std::fabs(f32::dot3(f.s, f.n)) < 3e-6);
        CHECK(std::fabs(f32::dot3(f.s, f.t)) < 1e-6);
        CHECK(f32::length3(f.s) == Approx(1).epsilon(1e-6));
        CHECK(f32::dot3(f.s, tangent) > 0);
        CHECK(std::fabs(f32::dot3(f.t, tangent)) < 1e-5f * f32::length3(tangent));
    }
    f32::ShadingFrame f =
        f32::frame_from_tangent(f32::v3(0, 0, 1), f32::v3(0, 0, 0)); // no tangent: any frame
    CHECK(f32::length3(f.s) == Approx(1));
}

TEST_CASE("Microfacets: GGX and Beckmann densities from alpha 1e-4 to 1", "[maths]") {
    Random random(46);
    Worst ggx, ggx_masking, ggx_visible, beckmann;
    for (int n = 0; n < 1000000; n++) {
        float au = float(random.log_between(1e-4, 1)), av = float(random.log_between(1e-4, 1));
        double slope = random.log_between(1e-3, 1e3) * std::min(au, av),
               phi = random.between(0, 2 * M_PI);
        double z = 1 / std::sqrt(1 + slope * slope);
        if (z < 1e-7) continue;
        f32::vec3 h = vec<F32>(slope * z * std::cos(phi), slope * z * std::sin(phi), z);
        f64::vec3 wide_h = wide(h);
        ggx.add(ulps(f32::ggx_d(h, au, av), f64::ggx_d(wide_h, au, av)));
        ggx_masking.add(ulps(f32::ggx_g1(h, au, av), f64::ggx_g1(wide_h, au, av)));
        f32::vec3 o = f32::v3(h.y, -h.x, h.z);
        ggx_visible.add(ulps(f32::ggx_visible_d(o, h, au, av),
                             f64::ggx_d(wide_h, au, av) * f64::ggx_g1(wide(o), au, av) / o.z));
        // The exponential turns an absolute error of its argument into a relative one.
        double exponent =
            f64::square(wide_h.x / au / wide_h.z) + f64::square(wide_h.y / av / wide_h.z);
        double truth = f64::beckmann_d(wide_h, au, av);
        if (exponent < 80)
            beckmann.add(std::fabs(f32::beckmann_d(h, au, av) / truth - 1) / 0x1p-23 /
                         (1 + exponent));
        if (!std::isfinite(f32::beckmann_d(h, au, av))) FAIL("Beckmann is not finite");
    }
    CHECK(ggx.value() <= 8);
    CHECK(ggx_masking.value() <= 8);
    CHECK(ggx_visible.value() <= 14);
    CHECK(beckmann.value() <= 8);
    // At the normal: 1 / (pi au av), also where a float's 1 - alpha^2 is 1.
    CHECK(f32::ggx_d(f32::v3(0, 0, 1), 1e-4f, 1e-4f) == Approx(1e8 / M_PI).epsilon(1e-6));
    CHECK(f32::beckmann_d(f32::v3(0, 0, 1), 0.5f, 0.25f) == Approx(8 / M_PI).epsilon(1e-6));
    CHECK(f32::ggx_g1(f32::v3(0, 0, 1), 0.5f, 0.5f) == 1);
    CHECK(f32::ggx_g1(f32::v3(1, 0, 0), 0.5f, 0.5f) == 0);
    CHECK(f32::beckmann_g1(f32::v3(0, 0, 1), 0.5f, 0.5f) == 1);
}

TEST_CASE("Power heuristic: two strategies' weights sum to 1, from 1e-38 to infinity", "[maths]") {
    Random random(47);
    Worst worst;
    for (int n = 0; n < 1000000; n++) {
        float a = float(random.log_between(1.2e-38, 3e38)),
              b = float(random.log_between(1.2e-38, 3e38));
        float wa = f32::power_heuristic(a, b), wb = f32::power_heuristic(b, a);
        worst.add(std::fabs(double(wa) + wb - 1) / 0x1p-23);
        if (n % 4 == 0) {
            float c =
                a * float(random.between(0.25, 4)); // comparable densities, where the value matters
            worst.add(std::fabs(f32::power_heuristic(a, c) - 1 / (1 + f64::square(double(c) / a))) /
                      0x1p-23);
        }
    }
    CHECK(worst.value() <= 2);
    CHECK(f32::power_heuristic(INFINITY, 1) == 1);
    CHECK(f32::power_heuristic(1, INFINITY) == 0);
    CHECK(f32::power_heuristic(1, 0) == 1);
    CHECK(f32::power_heuristic(0, 1) == 0);
    CHECK(f32::power_heuristic(2, 2) == 0.5f);
    for (int n = 0; n < 100000; n++) {
        float a = float(random.log_between(1e-30, 1e30)), b = a * float(random.between(0, 4));
        CHECK(std::fabs(f32::power_heuristic_inverse(1 / a, b) - f32::power_heuristic(a, b)) <=
              3 * 0x1p-23f);
    }
    CHECK(f32::power_heuristic_inverse(0, 1e38f) == 1);
    CHECK(f32::power_heuristic_inverse(1e38f, 1e38f) == 0);
}
