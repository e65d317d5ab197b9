// The long accumulator of the film: no error, no order, from the smallest single to sums of the
// largest.
#include "host/film/film_sums.h"
#include "host/numerics/exact_sum.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cfloat>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

/// Any finite single, of any size and sign.
float any_single(Random& random) {
    for (;;) {
        const auto x = std::bit_cast<float>(random.bits());
        if (std::isfinite(x)) return x;
    }
}

std::vector<float> singles(Random& random, int count) {
    std::vector<float> made(static_cast<std::size_t>(count));
    std::generate(made.begin(), made.end(), [&] { return any_single(random); });
    return made;
}

auto digits_of(const std::vector<float>& values) {
    ExactSum sum;
    for (float v : values)
        sum.add(v);
    return sum.digits();
}

double value_of(const std::vector<float>& values) {
    ExactSum sum;
    for (float v : values)
        sum.add(v);
    return sum.value().high;
}

} // namespace

TEST_CASE("Exact sums: one number is itself, of every exponent and either sign") {
    Random random(1);
    for (int i = 0; i < 200'000; i++) {
        const float x = any_single(random);
        const double found = value_of({x});
        INFO(x);
        REQUIRE(found == double{x});
    }
    for (int exponent = -149; exponent < 128; exponent++)
        for (float x : {std::ldexp(1.0F, exponent), -std::ldexp(1.0F, exponent)})
            REQUIRE(value_of({x}) == double{x});
}

TEST_CASE("Exact sums: what is added in any order has the same digits") {
    Random random(2);
    for (int round = 0; round < 50; round++) {
        std::vector<float> values = singles(random, 400);
        const auto first = digits_of(values);
        for (int turn = 0; turn < 5; turn++) {
            for (std::size_t i = values.size() - 1; i > 0; i--)
                std::swap(values[i], values[random.bits() % (i + 1)]);
            REQUIRE(digits_of(values) == first);
        }
    }
}

TEST_CASE("Exact sums: what is taken away again leaves nothing") {
    Random random(3);
    std::vector<float> values = singles(random, 1000);
    const std::size_t count = values.size();
    for (std::size_t i = 0; i < count; i++)
        values.push_back(-values[i]);
    for (std::size_t i = values.size() - 1; i > 0; i--)
        std::swap(values[i], values[random.bits() % (i + 1)]);
    CHECK(digits_of(values) == std::array<std::uint32_t, EXACT_WORDS>{});
}

TEST_CASE("Exact sums: as integers of 128 bits add up") {
    Random random(4);
    for (int round = 0; round < 100; round++) {
        ExactSum sum;
        __extension__ __int128 truth = 0; // in units of 2^-30
        for (int i = 0; i < 2000; i++) {
            const auto x = static_cast<float>(random.sign() * random.log_between(1e-2, 1e15));
            sum.add(x);
            truth += static_cast<__int128>(std::ldexp(double{x}, 30));
            const TwoDoubles found = sum.value();
            const auto whole = static_cast<__int128>(std::ldexp(found.high, 30)) +
                               static_cast<__int128>(std::ldexp(found.low, 30));
            REQUIRE(whole == truth);
        }
    }
}

TEST_CASE("Exact sums: negative sums of every size, whose ones reach through all digits") {
    for (int exponent = -149; exponent < 128; exponent++) {
        const float x = std::ldexp(1.0F, exponent);
        INFO(exponent);
        CHECK(value_of({x, -x, -x}) == -double{x});
        CHECK(value_of({-x, FLT_TRUE_MIN}) == FLT_TRUE_MIN - double{x});
        CHECK(value_of({FLT_TRUE_MIN, -FLT_TRUE_MIN, -x}) == -double{x});
    }
}

TEST_CASE("Exact sums: the largest and the smallest together") {
    ExactSum sum;
    for (int i = 0; i < 1000; i++)
        sum.add(FLT_MAX);
    sum.add(FLT_TRUE_MIN);
    CHECK(sum.value().high == 1000.0 * FLT_MAX);
    for (int i = 0; i < 1000; i++)
        sum.add(-FLT_MAX);
    CHECK(sum.value().high == double{FLT_TRUE_MIN});
}

TEST_CASE("Exact sums: an infinite number stays so, with its sign") {
    const float infinite = INFINITY;
    CHECK(value_of({1, infinite, -FLT_MAX}) == double{INFINITY});
    CHECK(value_of({-infinite, FLT_MAX, 3}) == -double{INFINITY});
    CHECK(value_of(std::vector<float>(100'000, infinite)) == double{INFINITY});
}

TEST_CASE("Exact sums: the terms of a spread add up to it without error") {
    // What a value is off as two doubles (2^-96), and what the truth here is.
    constexpr double off = 0x1p-95;
    Random random(5);
    for (int round = 0; round < 20'000; round++) {
        const f32::GroupSpread g{static_cast<float>(random.log_between(1e-6, 16)),
                                 static_cast<float>(random.sign() * random.log_between(1e-6, 1e6)),
                                 static_cast<float>(random.sign() * random.log_between(1e-6, 1e6)),
                                 static_cast<float>(random.log_between(1e-6, 1e6))};
        ExactSpread spread;
        spread.add(g);
        const TwoDoubles c{g.centre, 0}, w{g.weight, 0}, d{g.first, 0};
        const TwoDoubles first = d + c * w;
        const TwoDoubles second = TwoDoubles{g.second, 0} + TwoDoubles{2, 0} * c * d + c * c * w;
        const double unit = (c * c * w).high + g.second + std::fabs(2 * (c * d).high);
        REQUIRE(std::fabs((spread.first.value() + TwoDoubles{-1, 0} * first).high) <=
                off * (std::fabs(d.high) + std::fabs((c * w).high)));
        REQUIRE(std::fabs((spread.second.value() + TwoDoubles{-1, 0} * second).high) <= off * unit);
    }
    ExactSpread beyond; // squares that no single holds
    beyond.add({16, 1e30F, 0, 0});
    CHECK(beyond.second.value().high == double{INFINITY});
}

namespace {

/// The sum with itself, as films are added up.
std::array<std::uint32_t, EXACT_WORDS> twice(const std::array<std::uint32_t, EXACT_WORDS>& digits) {
    SumRow row(1);
    for (int time = 0; time < 2; time++)
        add_digits(row, 0, 1, [&](int k) { return &digits.at(k); });
    std::array<std::uint32_t, EXACT_WORDS> sum{};
    for (int k = 0; k < EXACT_WORDS; k++)
        sum.at(k) = row.digit(k)[0];
    return sum;
}

double value_of(const std::array<std::uint32_t, EXACT_WORDS>& digits) {
    return exact_value(digits.data(), 1).high;
}

} // namespace

TEST_CASE("Exact sums: 2^34 samples below 2^105 have the mean of one, to the bit") {
    Random random(9);
    for (int i = 0; i < 2000; i++) {
        const float x = any_single(random);
        if (std::fabs(x) >= 0x1p105F) continue; // sums from 2^139 on are read as infinite
        auto digits = digits_of({x});
        for (int doubled = 0; doubled < 34; doubled++)
            digits = twice(digits);
        const double mean = value_of(digits) * 0x1p-34;
        INFO(x);
        REQUIRE(mean == double{x});
    }
    // Of the largest that is, 2^10.
    auto digits = digits_of({-FLT_MAX});
    for (int doubled = 0; doubled < 10; doubled++)
        digits = twice(digits);
    CHECK(value_of(digits) == -std::ldexp(double{FLT_MAX}, 10));
}

TEST_CASE("Exact sums: what is small is not lost among 2^34 that are large") {
    // Twice 2^33 that nearly cancel, and the smallest single that there is.
    auto up = digits_of({1e10F}), down = digits_of({-1e10F});
    for (int doubled = 0; doubled < 33; doubled++)
        up = twice(up), down = twice(down);
    SumRow row(1);
    for (const auto& digits : {up, digits_of({0x1p-149F}), down})
        add_digits(row, 0, 1, [&](int k) { return &digits.at(k); });
    CHECK(exact_value(row.digit(0).data(), 1).high == 0x1p-149);
}
