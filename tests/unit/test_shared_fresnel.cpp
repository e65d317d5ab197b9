// Fresnel's formulas and refraction in float against long double: within ulps, also where the
// textbook forms fail.
#include <catch2/catch.hpp>

#include "host/numerics/fresnel_truth.h"

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

Long contrast(Long eta) { return (eta - 1) * (eta + 1); }

} // namespace

TEST_CASE("Fresnel: dielectric reflectance within 16 ulp, transmittance within 8, both from 0 to 1",
          "[fresnel]") {
    Random random(31);
    Worst reflectance, transmittance;
    bool in_range = true;
    for (int n = 0; n < 1000000; n++) {
        double eta = random_index(random);
        float c = random_cosine(random);
        // Close to the critical angle a float cosine decides nothing; see the next test.
        long double g_squared = ((long double)eta - 1) * (eta + 1) + (long double)c * c;
        f32::Fresnel f = f32::fresnel_dielectric(c, interface_of<F32>(eta));
        in_range &= f.reflectance >= 0 && f.reflectance <= 1 && f.transmittance >= 0 &&
                    f.transmittance <= 1.000001f;
        FresnelTruth truth = dielectric_truth(c, contrast(eta));
        if ((g_squared > 0) != (f.g > 0)) FAIL("wrong side of the critical angle");
        if (truth.reflectance > 1e-30L) reflectance.add(ulps(f.reflectance, truth.reflectance));
        transmittance.add(ulps(f.transmittance, truth.transmittance));
    }
    CHECK(in_range);
    CHECK(reflectance.value() <= 16);
    CHECK(transmittance.value() <= 8);
}

TEST_CASE("Fresnel: no direction near the critical angle is put on the wrong side", "[fresnel]") {
    Random random(32);
    int wrong = 0, inside = 0;
    for (int n = 0; n < 1000000; n++) {
        double eta = 1 / (1 + random.log_between(1e-4, 1.5));
        double critical = std::sqrt((1 - eta) * (1 + eta));
        float c = float(critical * (1 + random.between(-1e-6, 1e-6)));
        __float128 truth = ((__float128)eta - 1) * ((__float128)eta + 1) + (__float128)c * c;
        bool transmits = truth > 0;
        wrong += (f32::fresnel_dielectric(c, interface_of<F32>(eta)).g > 0) != transmits;
        inside += transmits;
    }
    CHECK(wrong == 0);
    CHECK(inside > 300000);
    CHECK(inside < 700000);
}

TEST_CASE("Fresnel: at grazing everything is reflected, from both sides", "[fresnel]") {
    for (double eta : {1.0, 1.000001, 1.5, 1 / 1.5, 2.5}) {
        CHECK(f32::fresnel_dielectric(0, interface_of<F32>(eta)).reflectance == 1);
        CHECK(f32::fresnel_dielectric(0, interface_of<F32>(eta)).transmittance == 0);
        CHECK(f64::fresnel_dielectric(0, interface_of<F64>(eta)).reflectance == 1);
    }
}

TEST_CASE("Fresnel: an index of 1 is no interface, to the bit", "[fresnel]") {
    Random random(33);
    for (int n = 0; n < 100000; n++) {
        f32::vec3 w = random.direction<F32>();
        f32::Fresnel f = f32::fresnel_dielectric(std::fabs(w.z), interface_of<F32>(1));
        f32::vec3 t = f32::refract_local(w, interface_of<F32>(1));
        if (f.reflectance != 0 || t.x != -w.x || t.y != -w.y || t.z != -w.z) FAIL("at z = " << w.z);
    }
}

TEST_CASE("Fresnel: conductor within 16 ulp, from 0 to 1", "[fresnel]") {
    Random random(34);
    Worst worst;
    bool in_range = true;
    for (int n = 0; n < 300000; n++) {
        float eta = float(random.log_between(0.05, 10)), k = float(random.log_between(1e-3, 20));
        if (n % 16 == 0) k = 0;
        float c = random_cosine(random);
        float r = f32::fresnel_conductor(c, eta, k);
        in_range &= r >= 0 && r <= 1;
        // An index below 1 with next to no absorption has a critical angle, where float cosines
        // decide nothing.
        if (eta < 1 && k < 0.1f) continue;
        worst.add(ulps(r, conductor_truth(c, {eta, k})));
    }
    CHECK(in_range);
    CHECK(worst.value() <= 16);
    CHECK(f32::fresnel_conductor(0.3f, 0, 1) == 1); // the mirror that loses nothing
    CHECK(f32::fresnel_conductor(0, 0, 1) == 1);
}

TEST_CASE("Fresnel: a conductor that does not absorb is a dielectric", "[fresnel]") {
    Random random(35);
    Worst worst;
    for (int n = 0; n < 100000; n++) {
        float eta = float(random.between(1.05, 2.5)), c = random_cosine(random);
        worst.add(ulps(f32::fresnel_conductor(c, eta, 0),
                       dielectric_truth(c, contrast(eta)).reflectance));
    }
    CHECK(worst.value() <= 16);
}

TEST_CASE("Refraction: unit length within 2 ulp and Snell's law within 4", "[fresnel]") {
    Random random(36);
    Worst length, snell;
    for (int n = 0; n < 1000000; n++) {
        double eta = random_index(random);
        f32::vec3 w = random.direction<F32>();
        f32::vec3 t = f32::refract_local(w, interface_of<F32>(eta));
        if (t.x == 0 && t.y == 0 && t.z == 0) continue;
        // The direction that comes in is of unit length only to rounding, and near grazing that is
        // magnified: what counts is the length against that of a refraction of this same vector in
        // long double.
        long double x = -w.x / (long double)eta, y = -w.y / (long double)eta;
        long double g = sqrtl(((long double)eta - 1) * (eta + 1) + (long double)w.z * w.z);
        long double z = -copysignl(g / eta, w.z);
        snell.add(double(hypotl(t.x - x, t.y - y) / 0x1p-24L / 2));
        length.add(double(
            fabsl(sqrtl(t.x * (long double)t.x + t.y * (long double)t.y + t.z * (long double)t.z) -
                  sqrtl(x * x + y * y + z * z)) /
            0x1p-23L));
        if (w.z * t.z >= 0) FAIL("refracted to the wrong side");
    }
    CHECK(length.value() <= 2);
    CHECK(snell.value() <= 4);
}
