// Every scene of scenes/closed_form against its truth: error against the right answer, not against
// another renderer.
#include "host/numerics/closed_form_truth.h"
#include "host/numerics/statistics.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace {

using namespace parhelion;
using namespace parhelion::numerics;
using closed_form::Check;
using closed_form::Row;

constexpr int seeds = 32;
constexpr double family_level = 0.01; // for all z-tests of this file together

Scene load_row(const Row& row) {
    RenderCommand command;
    command.scene_file = test::source_file("scenes/closed_form/" + row.folder + "/scene.xml");
    for (const auto& [name, value] : row.parameters)
        command.definitions.push_back(name + "=" + value);
    command.samples = row.spp;
    command.next_event = row.next_event;
    return test::load(command);
}

std::vector<Row> rows_with(std::vector<Check> checks) {
    std::vector<Row> some;
    for (const Row& row : closed_form::rows())
        if (std::count(checks.begin(), checks.end(), row.check)) some.push_back(row);
    return some;
}

/// Calls test(truth, value) for every pixel and channel.
template<class Test>
void for_each_value(const Row& row, const Image& image, Test test) {
    for (int c = 0; c < 3; c++) {
        const std::vector<float>& values = find_channel(image, std::string(1, "RGB"[c]))->values;
        for (int y = 0; y < image.height; y++)
            for (int x = 0; x < image.width; x++)
                test(row.truth(x, y)[c], values[y * image.width + x]);
    }
}

std::array<double, 3> mean_truth(const Row& row, const Image& image) {
    std::array<double, 3> mean{};
    for (int y = 0; y < image.height; y++)
        for (int x = 0; x < image.width; x++)
            for (int c = 0; c < 3; c++)
                mean[c] += row.truth(x, y)[c] / static_cast<double>(image.pixel_count());
    return mean;
}

} // namespace

TEST_CASE("closed forms without noise: every pixel is right to the bit or to rounding") {
    for (const Row& row : rows_with({Check::exact_bits, Check::noise_free})) {
        INFO(row.name);
        RenderResult result = test::render_quietly(load_row(row));
        CHECK(result.report.non_finite_samples == 0);
        double worst = 0.0;
        int wrong = 0;
        for_each_value(row, result.image, [&](double truth, float value) {
            bool right = row.check == Check::exact_bits
                             ? value == static_cast<float>(truth)
                             : std::abs(value - truth) <= row.tolerance * std::abs(truth);
            wrong += !right;
            if (truth != 0.0) worst = std::max(worst, std::abs(value - truth) / std::abs(truth));
        });
        fmt::print("{:<58} worst relative error {:.1e}\n", row.name, worst);
        INFO("worst relative error " << worst);
        CHECK(wrong == 0);
    }
}

TEST_CASE("closed forms with noise: the mean of independent seeds is the truth within its error") {
    std::vector<Row> rows = rows_with({Check::mean_z_test});
    double level = numerics::sidak_level(family_level, 3 * rows.size());
    for (const Row& row : rows) {
        INFO(row.name);
        Scene scene = load_row(row);
        std::array<numerics::Mean, 3> statistics;
        std::array<double, 3> truth{};
        for (int seed = 0; seed < seeds; seed++) {
            scene.sampler.seed = 1000 + seed;
            RenderResult result = test::render_quietly(scene);
            CHECK(result.report.non_finite_samples == 0);
            std::array<double, 3> mean = test::mean_rgb(result.image);
            for (int c = 0; c < 3; c++)
                statistics[c].add(mean[c]);
            truth = mean_truth(row, result.image);
        }
        for (int c = 0; c < 3; c++) {
            double error = statistics[c].error();
            double excess =
                std::max(0.0, std::abs(statistics[c].mean() - truth[c]) - row.tolerance * truth[c]);
            // Rounding of a float sum, for the scenes in which a strategy leaves no variance.
            double rounding = 2e-7 * truth[c];
            double p = numerics::student_two_sided(excess / std::hypot(error, rounding), seeds - 1);
            fmt::print("{:<58} {}: {:.7f} truth {:.7f} +- {:.1e} p {:.3f}\n", row.name, "RGB"[c],
                       statistics[c].mean(), truth[c], error, p);
            INFO("channel " << c << ": mean " << statistics[c].mean() << ", truth " << truth[c]
                            << ", standard error " << error);
            CHECK(p > level);
            CHECK(error <= 0.02 * truth[c]); // or the test could see nothing
        }
    }
}
