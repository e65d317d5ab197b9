// The film's sums and spreads, against long double. Over many samples: row `accumulation` of the
// catalogue.
#include "host/numerics/film_drift.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace parhelion;
using namespace parhelion::numerics;

TEST_CASE("Film: errors of sums that are only added up drift, which is why they are taken up") {
    f32::TwoReal sum{0, 0};
    constexpr int count = 10'000'000;
    for (int i = 0; i < count; i++)
        sum = f32::group_add(sum, 1000.5f);
    double mean = (double{sum.high} + sum.low) / count;
    CHECK(std::abs(mean / 1000.5 - 1) > 1e-3);
}

TEST_CASE("Film: a spread does not depend on the centres its groups were measured about") {
    Random random(3);
    double worst_mean = 0, worst_spread = 0;
    for (int round = 0; round < 20000; round++) {
        double middle = random.sign() * random.log_between(1e-3, 1e6);
        double width = std::abs(middle) * random.log_between(1e-6, 1e2);
        ExactSpread spread;
        std::vector<std::pair<long double, long double>> samples; // weight, value
        for (int group = 0; group < 20; group++) {
            f32::GroupSpread g{0, float(middle + width * random.between(-1, 1)), 0, 0};
            for (int k = random.bits() % 5; k > 0; k--) {
                float x = float(middle + width * random.between(-1, 1));
                float w = float(random.log_between(1e-4, 1)), d = x - g.centre;
                g.weight += w, g.first += w * d, g.second += w * d * d;
                samples.emplace_back(w, x);
            }
            spread.add(g);
        }
        long double total = 0, sum = 0, squares = 0;
        for (auto [w, x] : samples)
            total += w, sum += w * x;
        for (auto [w, x] : samples)
            squares += w * (x - sum / total) * (x - sum / total);
        if (samples.size() < 2) continue;
        double mean = spread.first.value().high / spread.weight.value().high;
        worst_mean = std::max(worst_mean, double(std::abs(mean - sum / total) / width));
        worst_spread = std::max(worst_spread, double(std::abs(spread.about(mean) / squares - 1)));
    }
    fmt::print("spread: mean off by {:.1e} of the width, spread by {:.1e}\n", worst_mean,
               worst_spread);
    CHECK(worst_mean < 1e-6);
    CHECK(worst_spread < 1e-4); // samples rounded to 16 ulps of their width
}

TEST_CASE("Film: a group of no weight changes nothing") {
    ExactSpread spread;
    spread.add({2, 3, 1, 5});
    const double before = spread.about(3.5);
    spread.add({0, 100, 0, 0});
    CHECK(spread.about(3.5) == before);
    CHECK(spread.weight.value().high == 2);
}
