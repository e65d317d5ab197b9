// Two ways to render the same: their means over many seeds.
#pragma once

#include "host/catalogue/check.h"
#include "host/catalogue/stress_run.h"
#include "host/numerics/image_figures.h"
#include "host/numerics/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "host/numerics/measure.h"

namespace parhelion::stress {

/// Welch's t-test of two means of n values each, with the degrees of freedom of Welch and
/// Satterthwaite, rounded.
inline double welch_p(const Mean& a, const Mean& b, int n) {
    double va = a.error() * a.error(), vb = b.error() * b.error();
    double freedom = (va + vb) * (va + vb) / ((va * va + vb * vb) / (n - 1));
    return student_two_sided((a.mean() - b.mean()) / std::sqrt(va + vb),
                             static_cast<int>(std::lround(freedom)));
}

struct WelchTest {
    std::string name{};
    int groups = 0;           ///< of seeds
    std::size_t of_tests = 1; ///< that the row makes, for Sidak's level
    double most_error = 0;    ///< standard error, relative: beyond it a test could see nothing
};

/// Of images first(seed) and second(seed), which give a MeanRgb: t-tests of all seeds, and whether
/// the p-values of groups of them are uniform.
template<class First, class Second>
Checks welch_checks(StressRun& run, const WelchTest& test, First first, Second second) {
    constexpr int group_size = 8; // seeds of one t-test, on each side
    using Means = std::array<Mean, 3>;
    Means a{}, b{}, group_a{}, group_b{};
    std::array<std::vector<double>, 3> p_values;
    auto seed = static_cast<std::uint32_t>(run.seed * 100'000);
    int seeds = test.groups * group_size;
    for (int n = 0; n < seeds; n++) {
        MeanRgb x = first(seed++), y = second(seed++);
        for (std::size_t c = 0; c < 3; c++) {
            a[c].add(x[c]), b[c].add(y[c]);
            group_a[c].add(x[c]), group_b[c].add(y[c]);
            if ((n + 1) % group_size) continue;
            p_values[c].push_back(welch_p(group_a[c], group_b[c], group_size));
            group_a[c] = group_b[c] = Mean();
        }
        run.done(static_cast<double>(n + 1) / seeds);
    }
    Checks checks;
    double most_error = 0;
    auto p_check = [&](const std::string& what, double p, std::uint64_t samples) {
        checks.push_back({.name = test.name + ", " + what,
                          .value = p,
                          .target = sidak_level(0.01, 6 * test.of_tests),
                          .at_least = true,
                          .unit = "p",
                          .samples = samples});
    };
    for (std::size_t c = 0; c < 3; c++) {
        std::string channel(1, "RGB"[c]);
        p_check(channel + ": means", welch_p(a[c], b[c], seeds), seeds);
        double error = std::hypot(a[c].error(), b[c].error()) / b[c].mean();
        most_error = std::max(most_error, error);
        checks.back().note = fmt::format("difference {:+.2e} +- {:.2e} (95 %), relative",
                                         a[c].mean() / b[c].mean() - 1, 1.96 * error);
        p_check(channel + ": p-values of groups of seeds are uniform",
                kolmogorov_smirnov_p(p_values[c]), p_values[c].size());
    }
    checks.push_back({.name = test.name + ": standard error of the difference",
                      .value = most_error,
                      .target = test.most_error,
                      .unit = "relative",
                      .samples = static_cast<std::uint64_t>(seeds)});
    return checks;
}

} // namespace parhelion::stress
