// What the film's sums and spreads make of any number of samples, against long double: for the
// test suite with 1e6 to 1e7 of them, for a full run of the catalogue with 1e9.
#pragma once

#include "host/numerics/exact_sum.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace parhelion::numerics {

/// A sequence of samples: the i-th, and a random number of [0, 1) for it. Most are near `near`.
struct FilmFeed {
    const char* name;
    double near;
    float (*sample)(std::int64_t i, float u);
};

// The list below is a table.
// clang-format off
inline const FilmFeed film_feeds[] = {
    {"1000 + U", 1000.5, [](std::int64_t, float u) { return 1000 + u; }},
    {"constant 1000.1", 1000.1f, [](std::int64_t, float) { return 1000.1f; }},
    {"constant 1/3", 1 / 3.f, [](std::int64_t, float) { return 1 / 3.f; }},
    {"1000 and the next float", 1000, [](std::int64_t, float u) { return u < .25f ? 1000.f : std::nextafter(1000.f, 2e3f); }},
    {"1e8, then U", .5, [](std::int64_t i, float u) { return i ? u : 1e8f; }},
    {"1e6 once in 1e6, else 1e-6 U", 0, [](std::int64_t i, float u) { return i % 1000003 == 17 ? 1e6f : 1e-6f * u; }},
    {"+-(1000 + U) by turns", 0, [](std::int64_t i, float u) { return (i & 1 ? -1 : 1) * (1000 + u); }},
};
// clang-format on

/// Errors over what a single rounding is judged by: of the mean over the mean of |sample|, of the
/// variance over the variance (absolute where there is none).
struct FilmDrift {
    double mean = 0, spread_mean = 0, variance = 0;
};

/// Adds `count` samples of weight 1 as the accumulate kernel does.
inline FilmDrift film_drift(const FilmFeed& feed, std::int64_t count, std::uint64_t seed = 1) {
    Random random(seed);
    ExactSum sum;
    ExactSpread spread;
    long double about = 0, squares = 0, size = 0; // the truth: sums of what differs from near
    float group[FILM_SAMPLES];
    for (std::int64_t begin = 0; begin < count; begin += FILM_SAMPLES) {
        int n = static_cast<int>(std::min<std::int64_t>(FILM_SAMPLES, count - begin));
        f32::TwoReal added{0, 0};
        f32::GroupSpread g{static_cast<float>(n), 0, 0, 0};
        for (int k = 0; k < n; k++) {
            group[k] = feed.sample(begin + k, static_cast<float>(random.unit()));
            long double d = group[k] - feed.near;
            about += d, squares += d * d, size += std::abs(group[k]);
            added = f32::group_add(added, group[k]);
            g.centre += group[k];
        }
        g.centre /= g.weight;
        for (int k = 0; k < n; k++) {
            float d = group[k] - g.centre;
            g.first += d, g.second += d * d;
        }
        sum.add(added);
        spread.add(g);
    }
    long double n = count, mean = feed.near + about / n,
                variance = (squares - about * about / n) / n;
    const double weight = spread.weight.value().high;
    auto relative = [](long double error, long double of) {
        return static_cast<double>(std::abs(of > 0 ? error / of : error));
    };
    const double found = sum.value().high / weight;
    return {relative(found - mean, size / n),
            relative(spread.first.value().high / weight - mean, size / n),
            relative(spread.about(found) / weight - variance, variance)};
}

} // namespace parhelion::numerics
