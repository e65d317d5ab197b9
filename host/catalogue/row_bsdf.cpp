// Every kind of material in the list: its samples follow the density that it states, and no more
// comes back than went in.
#include "host/catalogue/rows.h"
#include "host/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <string>

#include "host/numerics/density_test.h"

namespace parhelion::stress {
namespace {

std::string text_of(const Configuration& c) {
    return fmt::format("{}, cosine {:.6g}", c.material.name, c.wo.z);
}

/// The smallest of many p-values, by Sidak's level for as many. `view_done` is called once a view.
Checks density_checks(StressRun& run, const std::string& name,
                      const std::vector<Configuration>& list, std::uint64_t count,
                      const std::function<void()>& view_done) {
    std::vector<DensityTest> tests(list.size());
    parallel_for(list.size(), [&](std::size_t i) {
        tests[i] = test_density(list[i], count, run.seed + 1000 + i);
        view_done();
    });
    double level = sidak_level(0.01, 2 * list.size());
    Check directions{.name = name + ": chi-square of directions, smallest p",
                     .value = 1,
                     .target = level,
                     .at_least = true,
                     .unit = "p",
                     .samples = count * list.size(),
                     .note = fmt::format("{} views of {} samples", list.size(), count)};
    Check missing = directions, integral = directions;
    missing.name = name + ": share without a density, smallest p";
    integral.name = name + ": integral of the density over 1", integral.value = 0,
    integral.target = 1e-4, integral.at_least = false, integral.unit = "";
    for (std::size_t i = 0; i < list.size(); i++) {
        if (tests[i].p_value < directions.value)
            directions.value = tests[i].p_value, directions.worst_at = text_of(list[i]);
        if (tests[i].p_missing < missing.value)
            missing.value = tests[i].p_missing, missing.worst_at = text_of(list[i]);
        if (tests[i].integral - 1 > integral.value)
            integral.value = tests[i].integral - 1, integral.worst_at = text_of(list[i]);
    }
    return {directions, missing, integral};
}

/// Standard errors that the returned power of a white furnace is too high, the largest of three
/// channels.
double power_over_one(const Configuration& c, std::uint64_t count, std::uint64_t seed) {
    auto m = make_material<F32>(c.material);
    Random random(seed);
    std::array<Mean, 3> power;
    for (std::uint64_t n = 0; n < count; n++) {
        auto s = bsdf_sample(m, c.wo, random.square<F32>(), static_cast<float>(random.unit()));
        // Radiance scaled at the interface is turned back into power.
        auto scaled = f32::scale3(s.weight, s.eta * s.eta);
        for (int k = 0; k < 3; k++)
            power[k].add(component(scaled, k));
    }
    double worst = -INFINITY;
    for (const Mean& mean : power)
        worst = std::max(worst, (mean.mean() - most_sent_on(c.material)) / (mean.error() + 1e-6));
    return worst;
}

/// Few enough for many samples each.
std::vector<Configuration> anisotropic_at_60_degrees() {
    std::vector<Configuration> few;
    for (int kind = 0; kind < material_kind_count; kind++)
        for (const Configuration& c : configurations(kind, false)) {
            double cosine = std::fabs(c.wo.z);
            if (c.material.alpha_u != c.material.alpha_v && cosine > 0.4 && cosine < 0.6)
                few.push_back(c);
        }
    return few;
}

} // namespace

Checks row_density(StressRun& run) {
    Checks checks;
    std::uint64_t count = run.count(100'000, 300'000, 100'000'000);
    std::size_t views = 0;
#define COUNT_VIEWS(label, ...) views += configurations(material_##label, false).size();
    MATERIALS(COUNT_VIEWS)
    views += anisotropic_at_60_degrees().size();
    std::atomic<std::size_t> finished = 0;
    auto view_done = [&] {
        run.done(static_cast<double>(++finished) / static_cast<double>(views));
    };
#define TEST_KIND(label, ...)                                                                      \
    if (std::vector<Configuration> list = configurations(material_##label, false); !list.empty())  \
        for (const Check& check : density_checks(run, #label, list, count, view_done))             \
            checks.push_back(check);
    MATERIALS(TEST_KIND)
    std::vector<Configuration> few = anisotropic_at_60_degrees();
    for (const Check& check : density_checks(run, "anisotropic, at 60 degrees", few,
                                             std::max<std::uint64_t>(count, 1'000'000), view_done))
        checks.push_back(check);
    return checks;
}

Checks row_furnace(StressRun& run) {
    Checks checks;
    std::uint64_t count = run.count(20'000, 200'000, 10'000'000);
    auto test_kind = [&](const std::string& name, int kind) {
        std::vector<Configuration> list = configurations(kind, false);
        for (const Configuration& c : configurations(kind, true))
            list.push_back(c);
        std::vector<double> over(list.size());
        parallel_for(list.size(), [&](std::size_t i) {
            over[i] = power_over_one(list[i], count, run.seed + i);
        });
        std::size_t worst = std::max_element(over.begin(), over.end()) - over.begin();
        double level = sidak_level(0.01, 3 * list.size());
        checks.push_back({.name = name + ": white furnace, power above 1, smallest p",
                          .value = normal_two_sided(std::max(over[worst], 0.)),
                          .target = level,
                          .at_least = true,
                          .unit = "p",
                          .samples = count * list.size(),
                          .worst_at = text_of(list[worst])});
    };
#define FURNACE_KIND(label, ...) test_kind(#label, material_##label);
    MATERIALS(FURNACE_KIND)
    return checks;
}

} // namespace parhelion::stress
