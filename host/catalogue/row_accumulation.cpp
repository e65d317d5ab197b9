// A pixel's mean and variance after many samples: sums that stop growing, and squares that cancel,
// would show.
#include "host/catalogue/rows.h"
#include "host/parallel.h"

#include <fmt/format.h>

#include <array>
#include <atomic>

#include "host/numerics/film_drift.h"

namespace parhelion::stress {

Checks row_accumulation(StressRun& run) {
    std::uint64_t count = run.count(10'000'000, 10'000'000, 1'000'000'000);
    std::array<FilmDrift, std::size(film_feeds)> drift;
    std::atomic<std::size_t> finished = 0;
    parallel_for(drift.size(), [&](std::size_t i) {
        drift[i] = film_drift(film_feeds[i], static_cast<std::int64_t>(count), run.seed);
        run.done(static_cast<double>(++finished) / static_cast<double>(drift.size()));
    });
    Checks checks;
    for (std::size_t i = 0; i < drift.size(); i++) {
        auto check = [&](const char* what, double error, double target) {
            checks.push_back({.name = fmt::format("samples {}: {}", film_feeds[i].name, what),
                              .value = error,
                              .target = target,
                              .unit = "relative",
                              .samples = count});
        };
        bool full = run.effort == Effort::full;
        check("mean", drift[i].mean, full ? 1e-7 : 1e-9);
        check("mean beside the spread", drift[i].spread_mean, full ? 1e-5 : 1e-6);
        check("variance", drift[i].variance, full ? 1e-3 : 2e-6);
    }
    return checks;
}

} // namespace parhelion::stress
