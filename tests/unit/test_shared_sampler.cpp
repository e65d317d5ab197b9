// Random numbers and the maps from the unit square: uniform, independent, and within their ranges
// at the ends.
#include <catch2/catch.hpp>

#include "host/numerics/measure.h"
#include "host/numerics/statistics.h"
#include "tests/support/even_grid.h"

#include <array>
#include <set>

using namespace parhelion;
using namespace parhelion::numerics;
using test::grid_p_value;

namespace {

struct Pair {
    double x, y;
};

double top(f32::Random4 r, int output) {
    std::uint32_t v = output == 0 ? r.x : output == 1 ? r.y : output == 2 ? r.z : r.w;
    return f32::uniform01(v);
}

} // namespace

TEST_CASE("Sampler: uniform numbers are never below 0 and never 1", "[sampler]") {
    CHECK(f32::uniform01(0) == 0);
    CHECK(f32::uniform01(0xffffffffu) == 1 - 0x1p-24f);
    CHECK(f32::uniform01(0x80000000u) == 0.5f);
    for (std::uint64_t x = 0; x < (1ull << 32); x += 255)
        if (f32::uniform01(std::uint32_t(x)) != float(x >> 8) * 0x1p-24f) FAIL("at " << x);
}

TEST_CASE("Sampler: every pair of outputs is even over the square, along pixels, samples, "
          "dimensions and seeds",
          "[sampler]") {
    const int count = 1 << 18;
    std::vector<double> p_values;
    for (int input = 0; input < 4; input++)
        for (int a = 0; a < 4; a++)
            for (int b = a + 1; b < 4; b++)
                p_values.push_back(grid_p_value(
                    [&](std::uint32_t n) {
                        std::uint32_t at[4] = {7, 3, 5, 11};
                        at[input] += n;
                        f32::Random4 r = f32::random4(at[0], at[1], at[2], at[3]);
                        return Pair{top(r, a), top(r, b)};
                    },
                    count));
    double level = sidak_level(0.01, p_values.size());
    for (double p : p_values)
        CHECK(p > level);
}

TEST_CASE("Sampler: samples far up, where singles have no odd numbers, are as even and all others",
          "[sampler]") {
    const std::uint32_t count = 1 << 18;
    std::vector<double> p_values;
    for (const std::uint32_t end : {1u << 25, 1u << 30, (1u << 31) - 1}) {
        std::set<std::array<std::uint32_t, 4>> seen;
        for (int a = 0; a < 4; a++)
            for (int b = a + 1; b < 4; b++)
                p_values.push_back(grid_p_value(
                    [&](std::uint32_t n) {
                        const f32::Random4 r = f32::random4(7, end - 1 - n, 5, 11);
                        seen.insert({r.x, r.y, r.z, r.w});
                        return Pair{top(r, a), top(r, b)};
                    },
                    count));
        CHECK(seen.size() == count);
    }
    const double level = sidak_level(0.01, p_values.size());
    for (double p : p_values)
        CHECK(p > level);
}

TEST_CASE("Sampler: no output knows its neighbour in pixel, row, sample, dimension or seed",
          "[sampler]") {
    const int count = 1 << 18;
    std::vector<double> p_values;
    const std::uint32_t steps[][4] = {
        {1, 0, 0, 0}, {1024, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (const auto& step : steps)
        for (int output = 0; output < 4; output++)
            for (int other = 0; other < 4; other++)
                p_values.push_back(grid_p_value(
                    [&](std::uint32_t n) {
                        std::uint32_t pixel = n % 4096 * 2, sample = n / 4096 * 2;
                        f32::Random4 r = f32::random4(pixel, sample, 4, 9);
                        f32::Random4 s = f32::random4(pixel + step[0], sample + step[1],
                                                      4 + step[2], 9 + step[3]);
                        return Pair{top(r, output), top(s, other)};
                    },
                    count));
    double level = sidak_level(0.01, p_values.size());
    for (double p : p_values)
        CHECK(p > level);
}

TEST_CASE("Sampler: each of the 24 bits used is set half of the time", "[sampler]") {
    const int count = 1 << 21;
    std::vector<double> set(4 * 24);
    for (std::uint32_t n = 0; n < count; n++) {
        f32::Random4 r = f32::random4(n & 511, n >> 9 & 511, n >> 18, 0);
        const std::uint32_t outputs[4] = {r.x, r.y, r.z, r.w};
        for (std::size_t k = 0; k < set.size(); k++)
            set[k] += double(outputs[k / 24] >> (8 + k % 24) & 1);
    }
    double level = sidak_level(0.01, set.size());
    for (double s : set)
        CHECK(normal_two_sided((s - count / 2.0) / std::sqrt(count / 4.0)) > level);
}

TEST_CASE("Warps: uniform over triangle, disk and sphere, cosine over the hemisphere",
          "[sampler]") {
    Random random(51);
    const int count = 1000000;
    auto p_value = [&](auto cell) {
        return grid_p_value([&](std::uint32_t) { return cell(random.square<F32>()); }, count);
    };
    auto below_1 = [](double x) { return std::min(std::max(x, 0.0), 1 - 0x1p-30); };
    auto azimuth = [&](double y, double x) { return below_1(std::atan2(y, x) / (2 * M_PI) + 0.5); };
    double level = sidak_level(0.01, 4);
    CHECK(
        p_value(
            [&](f32::vec2 u) { // a uniform triangle in coordinates in which it is a uniform square
                f32::vec2 b = f32::triangle_uniform(u);
                double rest = 1 - double(b.x);
                return Pair{below_1(1 - rest * rest), below_1(b.y / rest)};
            }) > level);
    CHECK(p_value([&](f32::vec2 u) {
              f32::vec2 d = f32::disk_uniform(u);
              return Pair{below_1(double(d.x) * d.x + double(d.y) * d.y), azimuth(d.y, d.x)};
          }) > level);
    CHECK(p_value([&](f32::vec2 u) {
              f32::vec3 w = f32::sphere_uniform(u);
              return Pair{below_1((1 - double(w.z)) / 2), azimuth(w.y, w.x)};
          }) > level);
    CHECK(p_value([&](f32::vec2 u) {
              f32::vec3 w = f32::hemisphere_cosine(u);
              return Pair{below_1(double(w.x) * w.x + double(w.y) * w.y), azimuth(w.y, w.x)};
          }) > level);
}

TEST_CASE("Warps: within their ranges, also at the ends of the unit interval", "[sampler]") {
    Random random(52);
    const float ends[] = {0, 0x1p-24f, 0.25f, 0.5f, 0.75f, 1 - 0x1p-24f};
    auto check = [](f32::vec2 u) {
        f32::vec2 b = f32::triangle_uniform(u);
        if (!(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1)) FAIL("barycentrics " << b.x << " " << b.y);
        f32::vec2 d = f32::disk_uniform(u);
        if (!(std::hypot(double(d.x), double(d.y)) <= 1 + 2e-7)) FAIL("disk " << d.x << " " << d.y);
        f32::vec3 w = f32::hemisphere_cosine(u);
        if (!(w.z > 0 && std::fabs(f64::length3(wide(w)) - 1) <= 3e-7)) FAIL("hemisphere " << w.z);
        f32::vec3 s = f32::sphere_uniform(u);
        if (!(std::fabs(f64::length3(wide(s)) - 1) <= 3e-7)) FAIL("sphere " << s.z);
    };
    for (float x : ends)
        for (float y : ends)
            check({x, y});
    for (int n = 0; n < 1000000; n++)
        check(random.square<F32>());
    SUCCEED();
}

TEST_CASE(
    "Russian roulette keeps the mean, and never stops a path that lost nothing but to refraction",
    "[sampler]") {
    Random random(53);
    for (double throughput : {0.01, 0.3, 0.9, 5.0}) {
        Mean mean;
        for (int n = 0; n < 200000; n++) {
            f32::vec3 t = f32::splat3(float(throughput));
            f32::Roulette r = f32::russian_roulette(t, 1, float(random.unit()));
            mean.add(r.alive ? throughput * r.scale : 0);
        }
        CHECK(std::fabs(mean.mean() - throughput) <= 4 * mean.error());
    }
    // Inside a glass of index 1.5 radiance is scaled by 1 / 1.5^2; the path has lost no energy by
    // that.
    f32::Roulette r = f32::russian_roulette(f32::splat3(1 / 2.25f), 1.5f, 0.94f);
    CHECK(r.alive);
    CHECK(r.scale == Approx(1 / 0.95));
}
