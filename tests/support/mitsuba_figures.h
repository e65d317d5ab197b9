// Our own comparison scenes against what Mitsuba 3.9.1 made of them: stored figures, so that no
// Mitsuba is needed (tests/mitsuba/store_references.py).
//
// Of each case and channel the mean of the picture and of its regions are compared by Welch's
// t-test.
#pragma once

#include "host/commands/render.h"
#include "host/numerics/statistics.h"
#include "host/scene/load.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace parhelion::test::mitsuba_figures {

using nlohmann::json;

/// What float sums may differ by without any noise, relative.
inline constexpr double rounding = 1e-5;
/// The least variance of one sample that is believed: where the tail of a filter touches something
/// bright, few samples show any. As in Mitsuba's own tests.
inline constexpr double variance_floor = 1e-4;

/// A file of tests/mitsuba.
inline json read_json(const std::string& name) {
    std::ifstream in(PARHELION_SOURCE_DIR "/tests/mitsuba/" + name);
    REQUIRE(in);
    return json::parse(in);
}

/// Independent renders of a picture.
struct Effort {
    int seeds, samples; ///< samples of each seed, a pixel
    std::function<RenderResult(const Scene&)> render;
};

/// As the stored figures were made: with interpolated normals as they are, and rough lobes of
/// single scattering.
inline Scene load_case(const json& c, int samples) {
    RenderCommand command;
    command.scene_file = PARHELION_SOURCE_DIR "/tests/mitsuba/" + c.at("scene").get<std::string>();
    json parameters = c.value("parameters", json::object());
    for (const auto& [name, value] : parameters.items())
        command.definitions.push_back(name + "=" + value.get<std::string>());
    command.samples = samples;
    command.sampler = "independent", command.filter_method = "sampling";
    command.shading_normals = "raw";
    command.energy_compensation = false;
    Scene scene = load_scene(command.scene_file, {parse_definitions(command.definitions), false});
    apply_overrides(command, scene);
    return scene;
}

/// Mean of the picture, then of its grid x grid regions row by row.
inline std::vector<double> region_means(const Image& image, const std::vector<float>& values,
                                        int grid) {
    std::vector<double> means(1 + grid * grid);
    std::vector<double> counts(means.size());
    for (int row = 0; row < grid; row++)
        for (int column = 0; column < grid; column++)
            for (int y = row * image.height / grid; y < (row + 1) * image.height / grid; y++)
                for (int x = column * image.width / grid; x < (column + 1) * image.width / grid;
                     x++) {
                    int region = 1 + row * grid + column;
                    double value = values[image.index(x, y)];
                    means[0] += value, counts[0]++;
                    means[region] += value, counts[region]++;
                }
    for (std::size_t i = 0; i < means.size(); i++)
        means[i] /= counts[i];
    return means;
}

/// Welch's test of our mean against a stored [mean, standard error] of `renders` renders; `samples`
/// of ours in all.
inline double p_value(const numerics::Mean& ours, int seeds, double samples, const json& theirs,
                      int renders) {
    double mean = theirs.at(0), error = theirs.at(1);
    double va = ours.error() * ours.error(), vb = error * error;
    double known = va * va / (seeds - 1) + vb * vb / (renders - 1);
    double variance = std::max(va + vb, variance_floor / samples) +
                      std::pow(rounding * std::max(std::abs(mean), std::abs(ours.mean())), 2);
    double freedom = known > 0 ? std::min(variance * variance / known, 1e4) : 1e4;
    return numerics::student_two_sided((ours.mean() - mean) / std::sqrt(variance),
                                       static_cast<int>(freedom));
}

struct Verdict {
    double least_p = 1;
    std::string where;
};

/// All regions of all channels of a case.
inline Verdict compare_case(const json& c, const json& stored, const json& about,
                            const Effort& effort) {
    // Where the bright samples are rare, few say nothing, not even how much they spread.
    int samples = std::max(effort.samples, c.value("least_samples", 1));
    Scene scene = load_case(c, samples);
    int grid = about.at("grid"), renders = about.at("renders");
    std::map<std::string, std::vector<numerics::Mean>> ours;
    for (int seed = 0; seed < effort.seeds; seed++) {
        scene.sampler.seed = 1 + seed;
        RenderResult result = effort.render(scene);
        CHECK(result.report.non_finite_samples == 0);
        CHECK(json{result.image.width, result.image.height} == stored.at("size"));
        for (const Channel& channel : result.image.channels) {
            std::vector<double> means = region_means(result.image, channel.values, grid);
            auto& sums = ours[channel.name];
            sums.resize(means.size());
            for (std::size_t i = 0; i < means.size(); i++)
                sums[i].add(means[i]);
        }
    }
    Verdict verdict;
    CHECK(ours.size() == stored.at("channels").size());
    for (const auto& [name, figures] : stored.at("channels").items()) {
        INFO("channel " << name);
        REQUIRE(ours.count(name) == 1);
        for (std::size_t i = 0; i < figures.size(); i++) {
            double all = double(effort.seeds) * samples * scene.film.crop_width *
                         scene.film.crop_height / (i ? grid * grid : 1);
            double p = p_value(ours[name][i], effort.seeds, all, figures[i], renders);
            if (p < verdict.least_p)
                verdict = {p, fmt::format("{} region {}: {:.6g} +- {:.2g} against {} +- {}", name,
                                          i, ours[name][i].mean(), ours[name][i].error(),
                                          figures[i][0].dump(), figures[i][1].dump())};
        }
    }
    return verdict;
}

inline std::size_t figures_in(const json& cases) {
    std::size_t count = 0;
    for (const json& c : cases)
        for (const json& channel : c.at("channels"))
            count += channel.size();
    return count;
}

inline json case_of_name(const json& list, const std::string& name) {
    auto found =
        std::find_if(list.begin(), list.end(), [&](const json& c) { return c.at("name") == name; });
    REQUIRE(found != list.end());
    return *found;
}

/// Whether every case is Mitsuba's at the level `family` of all figures together.
inline void check_all_cases(const Effort& effort, double family) {
    json stored = read_json("references.json"), list = read_json("cases.json").at("cases");
    double level = numerics::sidak_level(family, figures_in(stored.at("cases")));
    std::size_t compared = 0;
    for (const json& c : list) {
        if (c.value("mitsuba_is_wrong", false)) continue;
        std::string name = c.at("name");
        INFO(name);
        Verdict v = compare_case(c, stored.at("cases").at(name), stored.at("about"), effort);
        fmt::print("{:<28} least p {:.1e}: {}\n", name, v.least_p, v.where);
        INFO(v.where);
        CHECK(v.least_p > level);
        compared++;
    }
    CHECK(compared == stored.at("cases").size());
}

} // namespace parhelion::test::mitsuba_figures
