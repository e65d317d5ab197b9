// Bounds of rounding errors and random numbers, as their papers print them.
#include "host/numerics/measure.h"

#include <catch2/catch.hpp>

#include <array>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

/// gamma(n) of Higham 2002, lemma 3.1, in single precision.
double gamma_of(int n) { return n * 0x1p-24 / (1 - n * 0x1p-24); }

void check_vector(f32::vec3 found, double x, double y, double z) {
    CHECK(found.x == Approx(x).epsilon(1e-5));
    CHECK(found.y == Approx(y).epsilon(1e-5));
    CHECK(found.z == Approx(z).epsilon(1e-5));
}

/// The hash as Jarzynski and Olano 2020 print it (listing of pcg4d).
std::array<std::uint32_t, 4> pcg4d(std::uint32_t x, std::uint32_t y, std::uint32_t z,
                                   std::uint32_t w) {
    std::array<std::uint32_t, 4> v{x, y, z, w};
    for (std::uint32_t& c : v)
        c = c * 1664525u + 1013904223u;
    auto mix = [&] {
        v[0] += v[1] * v[3];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
        v[3] += v[1] * v[2];
    };
    mix();
    for (std::uint32_t& c : v)
        c ^= c >> 16;
    mix();
    return v;
}

} // namespace

TEST_CASE("Papers: bounds of a hit's rounding error, Pharr, Jakob and Humphreys 2016, 3.9.4",
          "[papers]") {
    f32::Primitive p{};
    p.ax = 3, p.ay = -4, p.az = 5;
    p.bx = 7, p.by = 8, p.bz = -9;
    p.cx = -2, p.cy = 6, p.cz = 1;
    p.extra = inverse_normal_length(p);
    f32::SurfaceInteraction s = f32::surface_triangle(p, 0.25f, 0.5f);
    double g = gamma_of(7);
    check_vector(s.error, g * (3 * 0.25 + 7 * 0.25 + 2 * 0.5), g * (4 * 0.25 + 8 * 0.25 + 6 * 0.5),
                 g * (5 * 0.25 + 9 * 0.25 + 1 * 0.5));
    // A third coordinate below 0 takes nothing off: its size counts, like the others'.
    s = f32::surface_triangle(p, 0.75f, 0.5f);
    check_vector(s.error, g * (3 * 0.25 + 7 * 0.75 + 2 * 0.5), g * (4 * 0.25 + 8 * 0.75 + 6 * 0.5),
                 g * (5 * 0.25 + 9 * 0.75 + 1 * 0.5));

    p.bx = 1, p.by = 0, p.bz = 0, p.cx = 0, p.cy = 0, p.cz = 1;
    p.extra = 2;
    s = f32::surface_sphere(p, f32::v3(3 + 1.2f, -4, 5 - 1.6f));
    check_vector(s.error, g * (3 + 1.2), g * 4, g * (5 + 1.6));

    p.bx = 2, p.by = 0, p.bz = 1, p.cx = 0, p.cy = 3, p.cz = -1;
    p.extra = 1 / std::sqrt(9.f + 4 + 36);
    s = f32::surface_disk(p, -0.5f, 0.25f);
    check_vector(s.error, g * (3 + 0.5 * 2), g * (4 + 0.25 * 3), g * (5 + 0.5 + 0.25));
}

TEST_CASE("Papers: how far rays start off a surface, and where shadow rays end", "[papers]") {
    f32::vec3 error = f32::v3(1, 2, 3), n = f32::v3(0.6f, 0, -0.8f);
    double clearance = 0.6 * 1 + 0.8 * 3; // section 3.9.5: the error projected on the normal
    f32::vec3 c = f32::surface_clearance(error, n);
    check_vector(c, 0.6 * clearance, 0, -0.8 * clearance);
    f32::vec3 p = f32::v3(10, 20, 30);
    check_vector(leave_surface(p, c, n, f32::v3(1, 0, 0)), 10 + c.x, 20, 30 + c.z);
    check_vector(leave_surface(p, c, n, f32::v3(0, 0, 1)), 10 - c.x, 20, 30 - c.z);
    CHECK(f32::shadow_ray_end() == Approx(1 - gamma_of(32)).epsilon(1e-8));
}

TEST_CASE("Papers: bounds of a point on a light", "[papers]") {
    f32::Light l{};
    l.kind = emitter_area_disk, l.pmf = 1;
    l.ax = 1, l.ay = 10, l.az = -3;
    l.bx = 2, l.bz = 1, l.cy = 0.5f, l.cz = -1;
    l.extra = 1, l.area = 1, l.r = l.g = l.b = 1;
    f32::vec2 u{0.49f, 0.3f};
    f32::vec2 d = f32::disk_uniform(u);
    f32::EmitterSample s = f32::emitter_area_disk_sample(l, f32::v3(0, 0, 0), u);
    double g = gamma_of(7), x = std::fabs(d.x), y = std::fabs(d.y);
    check_vector(s.q_error, g * (1 + 2 * x), g * (10 + 0.5 * y), g * (3 + x + y));
    l.kind = emitter_area_sphere, l.bx = 0.5f;
    s = f32::emitter_area_sphere_sample(l, f32::v3(0, 0, 0), u);
    check_vector(s.q_error, g * (1 + std::fabs(s.q.x - 1)), g * (10 + std::fabs(s.q.y - 10)),
                 g * (3 + std::fabs(s.q.z + 3)));
    // Of corners: by area far away, plus 16 half-ulps of what the walk computes with.
    f32::vec3 p = f32::v3(500, 400, 300);
    f32::Light t{};
    t.kind = emitter_area_triangle, t.pmf = 1;
    t.ax = 1, t.ay = 2, t.az = 3, t.bx = 4, t.by = -1, t.bz = 2, t.cx = 0, t.cy = 1, t.cz = 5;
    t.extra = 1, t.area = 1;
    f32::vec2 b = f32::triangle_uniform(u);
    double b0 = 1 - b.x - b.y;
    double walk = gamma_of(16) * (499 + 496 + 500); // the largest coordinate, of three corners
    check_vector(f32::emitter_area_triangle_sample(t, p, u).q_error, g * (b0 + 4 * b.x) + walk,
                 g * (2 * b0 + b.x + b.y) + walk, g * (3 * b0 + 2 * b.x + 5 * b.y) + walk);
    t.kind = emitter_area_parallelogram;
    check_vector(f32::emitter_area_parallelogram_sample(t, p, u).q_error,
                 g * (1 + 5 * u.x + 1 * u.y) + walk, g * (2 + 3 * u.x + 3 * u.y) + walk,
                 g * (3 + 5 * u.x + 8 * u.y) + walk);
}

TEST_CASE("Papers: the hash is pcg4d of Jarzynski and Olano 2020", "[papers]") {
    Random random(48);
    for (int n = 0; n < 1000; n++) {
        std::uint32_t x = random.bits(), y = random.bits(), z = random.bits(), w = random.bits();
        std::array<std::uint32_t, 4> v = pcg4d(x, y, z, w);
        f32::Random4 r = f32::random4(x, y, z, w);
        REQUIRE((r.x == v[0] && r.y == v[1] && r.z == v[2] && r.w == v[3]));
        REQUIRE(f32::uniform01(v[0]) == float(v[0] >> 8) / 0x1p24f);
        REQUIRE((f32::uniform2(v[0], v[1]).x == f32::uniform01(v[0]) &&
                 f32::uniform2(v[0], v[1]).y == f32::uniform01(v[1])));
    }
}

TEST_CASE("Papers: frames are those of Duff et al. 2017", "[papers]") {
    Random random(49);
    for (int n = 0; n < 1000; n++) {
        f64::vec3 v = random.direction<F64>();
        double sign = std::copysign(1.0, v.z), a = -1 / (sign + v.z), b = v.x * v.y * a;
        f64::ShadingFrame f = frame_from_normal(v);
        REQUIRE(f.s.x == Approx(1 + sign * v.x * v.x * a));
        REQUIRE(f.s.y == Approx(sign * b));
        REQUIRE(f.s.z == Approx(-sign * v.x));
        REQUIRE(f.t.x == Approx(b));
        REQUIRE(f.t.y == Approx(sign + v.y * v.y * a));
        REQUIRE(f.t.z == Approx(-v.y));
    }
}
