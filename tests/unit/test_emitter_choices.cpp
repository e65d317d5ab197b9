// A light is chosen by solid angle or by area, by rules that a sample and a ray that meets the
// light must read alike: where one rule takes over from the other, both have to.
#include "host/numerics/measure.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

f64::Light corners_light(EmitterKind kind) {
    f64::Light l{};
    l.kind = kind, l.pmf = 0.25;
    l.bx = 2, l.cy = 1; // corners 0, (2, 0, 0) and (0, 1, 0): it shines to +z
    l.extra = 0.5, l.area = kind == emitter_area_triangle ? 1 : 2;
    l.r = l.g = l.b = 3;
    return l;
}

/// From grazing, where it is seen under less than a thousandth, to right above it and far away.
std::vector<f64::vec3> viewpoints() {
    std::vector<f64::vec3> points;
    for (int n = 0; n < 6000; n++) {
        double height = 1e-5 * std::pow(1e7, n / 6000.0);
        points.push_back(f64::v3(0.9, 0.4, height));
        points.push_back(f64::v3(-0.3, 0.5, height));
        points.push_back(f64::v3(2.2, -0.4, height));
    }
    return points;
}

} // namespace

TEST_CASE("Emitters: sample and density go from solid angle to area at the same place",
          "[emitter]") {
    for (EmitterKind kind : {emitter_area_triangle, emitter_area_parallelogram}) {
        f64::Light l = corners_light(kind);
        bool by_angle = false, by_area = false;
        for (f64::vec3 p : viewpoints()) {
            f64::EmitterSample s = emitter_sample(l, p, {0.37, 0.61});
            if (!(s.inverse_pdf > 0)) continue;
            INFO("kind " << kind << " from " << p.x << " " << p.y << " " << p.z);
            f64::EmitterHit hit = emitter_hit(l, p, s.wi, s.q, true);
            REQUIRE(hit.pdf * s.inverse_pdf == Approx(1).epsilon(1e-6));
            REQUIRE(s.weight.x == Approx(3 * s.inverse_pdf).epsilon(1e-12));
            // By solid angle every sample has the same density.
            f64::EmitterSample other = emitter_sample(l, p, {0.8, 0.1});
            bool even = std::fabs(other.inverse_pdf - s.inverse_pdf) < 1e-9 * s.inverse_pdf;
            (even ? by_angle : by_area) = true;
        }
        CHECK(by_angle);
        CHECK(by_area);
    }
}

TEST_CASE("Emitters: a point light and a sun have no density, and nothing meets them",
          "[emitter]") {
    f64::Light l{};
    l.az = 2, l.bz = -1, l.cx = 0.5, l.cy = 1, l.cz = 2, l.extra = 0.9, l.r = l.g = l.b = 3,
    l.pmf = 1;
    for (EmitterKind kind : {emitter_point, emitter_spot, emitter_directional}) {
        l.kind = kind;
        for (f64::vec3 wi : {f64::v3(0, 0, 1), f64::v3(0.6, 0, 0.8), f64::v3(0.3, 0.5, -0.8)}) {
            f64::EmitterHit hit = emitter_hit(l, f64::v3(0, 0, 0), wi, f64::v3(0, 0, 2), true);
            CHECK(hit.pdf == 0);
            CHECK(hit.radiance.x == 0);
        }
        CHECK(emitter_sample(l, f64::v3(0, 0, 0), {0.1, 0.2}).inverse_pdf == 0);
    }
    l.kind = emitter_constant;
    for (f64::vec3 wi : {f64::v3(0, 0, 1), f64::v3(0.6, 0, 0.8)}) {
        f64::EmitterHit hit = emitter_hit(l, f64::v3(0, 0, 0), wi, f64::v3(0, 0, 0), true);
        CHECK(hit.pdf == Approx(1 / (4 * M_PI)));
        CHECK(hit.radiance.x == 3);
    }
}

TEST_CASE("Emitters: a spot is full within its beam, linear in the angle, dark from its cutoff on",
          "[emitter]") {
    f64::Light l{};
    const double beam = 0.2, cutoff = 0.6;
    l.kind = emitter_spot, l.az = 2, l.bz = -1, l.pmf = 0.5;
    l.cx = std::cos(cutoff), l.cy = cutoff, l.cz = 1 / (cutoff - beam), l.extra = std::cos(beam);
    l.r = 3, l.g = 5, l.b = 7;
    for (double angle : {0.0, 0.1, 0.199, 0.201, 0.3, 0.45, 0.599, 0.601, 1.0}) {
        INFO("angle " << angle);
        f64::vec3 p = f64::v3(2 * std::tan(angle), 0, 0);
        double share = angle < beam ? 1 : angle < cutoff ? (cutoff - angle) / (cutoff - beam) : 0;
        double squared = 4 + p.x * p.x;
        f64::EmitterSample s = emitter_sample(l, p, {0.1, 0.2});
        CHECK(s.weight.x == Approx(3 / squared * share / 0.5).margin(1e-9));
        CHECK(s.weight.y == Approx(5 / squared * share / 0.5).margin(1e-9));
        CHECK(s.weight.z == Approx(7 / squared * share / 0.5).margin(1e-9));
        CHECK(s.wi.z == Approx(2 / std::sqrt(squared)));
    }
}
