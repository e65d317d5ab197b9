// The pattern of samples: stratified as its sequence promises after every scramble, even over the
// scrambles, and independent between decisions.
#include <catch2/catch.hpp>

#include "host/numerics/measure.h"
#include "host/numerics/statistics.h"
#include "tests/support/even_grid.h"

#include <array>
#include <bit>
#include <set>

using namespace parhelion;
using namespace parhelion::numerics;
using test::grid_p_value;

namespace {

using Point = std::array<std::uint32_t, 4>;

Point point(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension,
            std::uint32_t seed) {
    f32::Random4 r = f32::faure4({pixel, seed, sample, 0}, dimension);
    return {r.x, r.y, r.z, r.w};
}

std::uint32_t top_bits(std::uint32_t x, int count) { return count == 0 ? 0 : x >> (32 - count); }

/// Cells without exactly one of the points; bits[d]: dimension d is cut into 2^bits[d] parts, as
/// many cells in all as there are points.
int unfilled_cells(const std::vector<Point>& points, const std::array<int, 4>& bits) {
    std::vector<int> hits(points.size());
    for (const Point& p : points) {
        std::size_t cell = 0;
        for (std::size_t d = 0; d < 4; d++)
            cell = (cell << bits[d]) | top_bits(p[d], bits[d]);
        hits[cell]++;
    }
    return int(std::count_if(hits.begin(), hits.end(), [](int h) { return h != 1; }));
}

/// 2^m neighbouring samples of some pixel, the first a multiple of 2^m: what a pixel has rendered
/// after a power of two samples, or has added since.
std::vector<Point> aligned_block(Random& random, int m) {
    std::uint32_t pixel = random.bits(), dimension = random.bits() % 100, seed = random.bits();
    std::uint32_t first = (random.bits() >> 1) >> m << m;
    std::vector<Point> points;
    for (std::uint32_t n = 0; n < 1u << m; n++)
        points.push_back(point(pixel, first + n, dimension, seed));
    return points;
}

} // namespace

TEST_CASE("Faure: each coordinate of 2^m samples is in each of 2^m parts once", "[sampler]") {
    Random random(61);
    for (int m = 0; m <= 12; m++)
        for (int repeat = 0; repeat < 8; repeat++) {
            std::vector<Point> points = aligned_block(random, m);
            for (std::size_t d = 0; d < 4; d++) {
                std::array<int, 4> bits{};
                bits[d] = m;
                if (unfilled_cells(points, bits)) FAIL("2^" << m << " samples, coordinate " << d);
            }
        }
    SUCCEED();
}

TEST_CASE("Faure: (x, y) and (z, w) of 2^m samples fill every elementary interval of the square",
          "[sampler]") {
    Random random(62);
    for (int m = 0; m <= 11; m++)
        for (int repeat = 0; repeat < 8; repeat++) {
            std::vector<Point> points = aligned_block(random, m);
            for (int a = 0; a <= m; a++) {
                CAPTURE(m, a);
                if (unfilled_cells(points, {a, m - a, 0, 0})) FAIL("first pair");
                if (unfilled_cells(points, {0, 0, a, m - a})) FAIL("second pair");
            }
        }
    SUCCEED();
}

TEST_CASE("Faure: 4^m samples fill every elementary interval in base 4 of the hypercube",
          "[sampler]") {
    Random random(63);
    for (int m = 0; m <= 5; m++)
        for (int repeat = 0; repeat < 8; repeat++) {
            std::vector<Point> points = aligned_block(random, 2 * m);
            for (int a = 0; a <= m; a++)
                for (int b = 0; a + b <= m; b++)
                    for (int c = 0; a + b + c <= m; c++) {
                        std::array<int, 4> bits{2 * a, 2 * b, 2 * c, 2 * (m - a - b - c)};
                        CAPTURE(m, a, b, c);
                        if (unfilled_cells(points, bits)) FAIL("not filled");
                    }
        }
    SUCCEED();
}

TEST_CASE("Faure: the last samples of as many as there can be fill their parts like the first",
          "[sampler]") {
    for (const std::uint32_t first : {0u, 1u << 24, 1u << 30, (1u << 31) - 4096})
        for (const int m : {0, 4, 12}) {
            std::vector<Point> points;
            for (std::uint32_t n = 0; n < 1u << m; n++)
                points.push_back(point(3, first + 4096 - (1u << m) + n, 8, 1));
            for (std::size_t d = 0; d < 4; d++) {
                std::array<int, 4> bits{};
                bits[d] = m;
                CHECK(unfilled_cells(points, bits) == 0);
            }
            CHECK(unfilled_cells(points, {m / 2, m - m / 2, 0, 0}) == 0);
        }
    // And together with those before them: 2^12 of 2^31, spread evenly, fill 2^12 parts.
    std::vector<Point> spread;
    for (std::uint32_t n = 0; n < 4096; n++)
        spread.push_back(point(3, n << 19, 8, 1));
    CHECK(std::set<Point>(spread.begin(), spread.end()).size() == spread.size());
}

TEST_CASE("Faure: one sample is even over the square for every pair of coordinates, along pixels, "
          "dimensions and seeds",
          "[sampler]") {
    const int count = 1 << 16;
    std::vector<double> p_values;
    for (int input : {0, 2, 3})
        for (std::uint32_t sample : {0u, 1u, 1000u})
            for (std::size_t a = 0; a < 4; a++)
                for (std::size_t b = a + 1; b < 4; b++)
                    p_values.push_back(grid_p_value(
                        [&](std::uint32_t n) {
                            std::uint32_t at[4] = {7, sample, 5, 11};
                            at[input] += n;
                            Point p = point(at[0], at[1], at[2], at[3]);
                            return std::pair{p[a], p[b]};
                        },
                        count));
    double level = sidak_level(0.01, p_values.size());
    for (double p : p_values)
        CHECK(p > level);
}

TEST_CASE("Faure: one sample is even over the hypercube along pixels", "[sampler]") {
    const int count = 1 << 20;
    std::vector<double> observed(4096), expected(4096, count / 4096.0);
    for (std::uint32_t pixel = 0; pixel < count; pixel++) {
        std::size_t cell = 0;
        for (std::uint32_t x : point(pixel, 3, 2, 0))
            cell = cell * 8 + top_bits(x, 3);
        observed[cell]++;
    }
    CHECK(chi_square_p(observed, expected) > 0.01);
}

TEST_CASE("Faure: no coordinate knows its neighbour in pixel, row, dimension or seed, nor an "
          "earlier sample but by the pattern",
          "[sampler]") {
    const int count = 1 << 16;
    std::vector<double> p_values;
    const std::uint32_t steps[][4] = {{1, 0, 0, 0}, {1024, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (const auto& step : steps)
        for (std::size_t a = 0; a < 4; a++)
            for (std::size_t b = 0; b < 4; b++) {
                // Along pixels, and along the samples of a few pixels: padded sets must be even
                // together, too, where each is evenly spread by itself.
                auto neighbours = [&](std::uint32_t pixel, std::uint32_t sample) {
                    Point p = point(pixel, sample, 4, 9);
                    Point q = point(pixel + step[0], sample + step[1], 4 + step[2], 9 + step[3]);
                    return std::pair{p[a], q[b]};
                };
                p_values.push_back(
                    grid_p_value([&](std::uint32_t n) { return neighbours(2 * n, 5); }, count));
                p_values.push_back(grid_p_value(
                    [&](std::uint32_t n) { return neighbours(n / 64 * 2, n % 64); }, count));
            }
    double level = sidak_level(0.01, p_values.size());
    for (double p : p_values)
        CHECK(p > level);
}

TEST_CASE("Faure: every bit is set half of the time", "[sampler]") {
    const int count = 1 << 19;
    std::vector<double> set(4 * 32);
    for (std::uint32_t n = 0; n < count; n++) {
        Point p = point(n, 77, 1, 0);
        for (std::size_t k = 0; k < set.size(); k++)
            set[k] += double(p[k / 32] >> (k % 32) & 1);
    }
    double level = sidak_level(0.01, set.size());
    for (double s : set)
        CHECK(normal_two_sided((s - count / 2.0) / std::sqrt(count / 4.0)) > level);
}

TEST_CASE("Faure: a scramble moves a bit by those above it alone, and back and forth is the same",
          "[sampler]") {
    Random random(64);
    for (int n = 0; n < 100000; n++) {
        std::uint32_t x = random.bits(), y = random.bits(), seed = random.bits();
        CHECK(f32::reverse_bits(f32::reverse_bits(x)) == x);
        if (x == y) continue;
        // The first place where two numbers differ stays the first: a nested permutation.
        std::uint32_t sx = f32::owen_scramble(f32::reverse_bits(x), seed),
                      sy = f32::owen_scramble(f32::reverse_bits(y), seed);
        if (std::countl_zero(x ^ y) != std::countl_zero(sx ^ sy))
            FAIL(x << " and " << y << " with " << seed);
    }
}

TEST_CASE("Faure: at 64 samples means of smooth functions vary by a twentieth of independent ones",
          "[sampler]") {
    auto integrand = [](const std::array<double, 4>& u) {
        double sum = 0;
        for (double x : u)
            sum += (x - 0.4) * (x - 0.4);
        return std::exp(-2 * sum);
    };
    Mean means[2];
    for (std::uint32_t pixel = 0; pixel < 2000; pixel++)
        for (bool pattern : {false, true}) {
            double sum = 0;
            for (std::uint32_t sample = 0; sample < 64; sample++) {
                f32::Random4 r = pattern ? f32::faure4({pixel, 1, sample, 0}, 3)
                                         : f32::random4(pixel, sample, 3, 1);
                sum += integrand({f32::uniform01(r.x), f32::uniform01(r.y), f32::uniform01(r.z),
                                  f32::uniform01(r.w)}) /
                       64;
            }
            means[pattern].add(sum);
        }
    CHECK(f64::square(means[1].error()) < f64::square(means[0].error()) / 20);
    CHECK(std::fabs(means[0].mean() - means[1].mean()) <
          4 * std::hypot(means[0].error(), means[1].error()));
}

TEST_CASE("Faure: replicates take turns, each a pattern of its own, the first as without") {
    for (int bits = 0; bits <= 3; bits++)
        for (std::uint32_t sample = 0; sample < 100; sample++) {
            f32::SampleNumber n = f32::sample_number(5, sample, 9, bits);
            CHECK(n.replicate == sample % (1u << bits));
            CHECK(n.index == sample / (1u << bits));
            CHECK(n.pixel == 5);
            CHECK(n.seed == 9);
        }
    // Each by itself fills the intervals; all together are no more even than chance, as patterns
    // that know nothing of each other.
    std::vector<double> p_values;
    for (std::uint32_t a = 0; a < 8; a++) {
        std::vector<Point> points;
        for (std::uint32_t index = 0; index < 256; index++) {
            f32::Random4 r = f32::faure4({3, 1, index, a}, 7);
            points.push_back({r.x, r.y, r.z, r.w});
        }
        CHECK(unfilled_cells(points, {2, 2, 2, 2}) == 0);
        for (std::uint32_t b = 0; b < a; b++)
            p_values.push_back(grid_p_value(
                [&](std::uint32_t n) {
                    return std::pair{f32::faure4({n / 64, 1, n % 64, a}, 7).x,
                                     f32::faure4({n / 64, 1, n % 64, b}, 7).x};
                },
                1 << 16));
    }
    double level = sidak_level(0.01, p_values.size());
    for (double p : p_values)
        CHECK(p > level);
}

TEST_CASE("Faure: how far replicates' means differ is the error of their mean") {
    auto integrand = [](const f32::Random4& r) {
        double x = f32::uniform01(r.x), y = f32::uniform01(r.y);
        return std::exp(-3 * x * x) * (1 + y);
    };
    // Of 4 replicates of 16 samples, in many pixels: their spread against the true error.
    Mean error, told;
    const double truth = 0.5 * std::sqrt(M_PI / 3) * std::erf(std::sqrt(3.0)) * 1.5;
    for (std::uint32_t pixel = 0; pixel < 4000; pixel++) {
        double means[4] = {}, mean = 0, spread = 0;
        for (std::uint32_t sample = 0; sample < 64; sample++)
            means[sample % 4] +=
                integrand(f32::faure4(f32::sample_number(pixel, sample, 2, 2), 3)) / 16;
        for (double m : means)
            mean += m / 4;
        for (double m : means)
            spread += (m - mean) * (m - mean) / 3;
        error.add((mean - truth) * (mean - truth));
        told.add(spread / 4);
    }
    CHECK(std::fabs(error.mean() - told.mean()) < 4 * std::hypot(error.error(), told.error()));
    CHECK(told.error() < 0.1 * told.mean());
}
