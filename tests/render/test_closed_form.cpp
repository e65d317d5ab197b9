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
using closed_form::Judgement;
using closed_form::Setting;

Scene load_setting(const Setting& setting) {
    RenderCommand command;
    command.scene_file = test::source_file("scenes/closed_form/" + setting.folder + "/scene.xml");
    for (const auto& [name, value] : setting.parameters)
        command.definitions.push_back(name + "=" + value);
    command.samples = setting.spp;
    command.next_event = setting.next_event;
    return test::load(command);
}

std::vector<Setting> settings_with(std::vector<Judgement> judgements) {
    std::vector<Setting> some;
    for (const Setting& setting : closed_form::settings())
        if (std::count(judgements.begin(), judgements.end(), setting.judgement))
            some.push_back(setting);
    return some;
}

/// Calls test(truth, value) for every pixel and channel.
template<class Test>
void for_each_value(const Setting& setting, const Image& image, Test test) {
    for (int c = 0; c < 3; c++) {
        const std::vector<float>& values = find_channel(image, std::string(1, "RGB"[c]))->values;
        for (int y = 0; y < image.height; y++)
            for (int x = 0; x < image.width; x++)
                test(setting.truth(x, y)[c], values[y * image.width + x]);
    }
}

} // namespace

TEST_CASE("closed forms without noise: every pixel is right to the bit or to rounding") {
    for (const Setting& setting : settings_with({Judgement::exact_bits, Judgement::noise_free})) {
        INFO(setting.name);
        RenderResult result = test::render_quietly(load_setting(setting));
        CHECK(result.report.non_finite_samples == 0);
        double worst = 0.0;
        int wrong = 0;
        for_each_value(setting, result.image, [&](double truth, float value) {
            bool right = setting.judgement == Judgement::exact_bits
                             ? value == static_cast<float>(truth)
                             : std::abs(value - truth) <= setting.tolerance * std::abs(truth);
            wrong += !right;
            if (truth != 0.0) worst = std::max(worst, std::abs(value - truth) / std::abs(truth));
        });
        fmt::print("{:<58} worst relative error {:.1e}\n", setting.name, worst);
        INFO("worst relative error " << worst);
        CHECK(wrong == 0);
    }
}
