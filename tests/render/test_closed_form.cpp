// Scenes of scenes/closed_form without noise against their truth: error against the right answer,
// not against another renderer. Those with noise: row `closed_forms` of the catalogue.
#include "host/numerics/closed_form_truth.h"
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
