// Tables of reconstruction filters, each bin's mass and the draws against the filter's formula.
#include "host/catalogue/filter_draws.h"

#include "host/flatten/filter_table.h"
#include "host/numerics/statistics.h"
#include "host/twin/device_functions.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/numerics/measure.h"

namespace parhelion::stress {
namespace {

/// Integral of |filter| over [a, b], by the midpoint rule, with its sign kept apart.
double filter_mass(const ReconstructionFilter& filter, double a, double b) {
    constexpr int steps = 400;
    double sum = 0;
    for (int i = 0; i < steps; i++)
        sum += std::fabs(filter_value(filter, a + (b - a) * (i + 0.5) / steps));
    return sum * (b - a) / steps;
}

} // namespace

Checks filter_draws(StressRun& run) {
    std::uint64_t count = run.count(50'000, 1'000'000, 100'000'000);
    const std::pair<const char*, FilterKind> kinds[] = {
#define NAMED_FILTER(name) {#name, FilterKind::name},
        FILTER_KINDS(NAMED_FILTER)
#undef NAMED_FILTER
    };
    Checks checks;
    Random random(run.seed);
    for (const auto& [name, kind] : kinds) {
        ReconstructionFilter filter;
        filter.kind = kind;
        std::vector<FilterBin> table = make_filter_table(filter);
        double weights = 0, whole = 0;
        std::size_t bins = table.size() - 1;
        std::vector<double> masses;
        for (std::size_t k = 0; k < bins; k++) {
            masses.push_back(filter_mass(filter, table[k].x, table[k + 1].x));
            whole += masses.back();
            weights += table[k].weight;
        }
        Worst mass;
        for (double m : masses)
            mass.add(std::fabs(m / whole - 1. / static_cast<double>(bins)));
        // A bin's samples are evenly spread, which is as fine as the table tells: one is counted
        // for the bin that it lies in, whose mass is the formula's.
        std::vector<double> observed(bins), expected;
        for (std::uint64_t i = 0; i < count; i++) {
            float x = sample_filter(table, static_cast<float>(random.unit())).offset;
            auto next = std::upper_bound(table.begin() + 1, table.end() - 1, x,
                                         [](float at, const FilterBin& bin) { return at < bin.x; });
            observed[next - table.begin() - 1]++;
        }
        for (double m : masses)
            expected.push_back(static_cast<double>(count) * m / whole);
        auto check = [&, name = name](const char* what, double value, double target) {
            checks.push_back({.name = fmt::format("filter {}: {}", name, what),
                              .value = value,
                              .target = target,
                              .unit = "relative",
                              .samples = count});
        };
        check("mass of a bin", mass.value(), 1e-6);
        check("mean weight, off 1", std::fabs(weights / static_cast<double>(bins) - 1), 1e-6);
        check("chi-square of offsets", chi_square_p(observed, expected), 0.001);
        checks.back().at_least = true, checks.back().unit = "p";
    }
    return checks;
}

} // namespace parhelion::stress
