// Our own comparison scenes against what Mitsuba 3.9.1 made of them: stored figures, so that no
// Mitsuba is needed (tests/mitsuba/store_references.py).
//
// Of each case and channel the mean of the picture and of its regions are compared by Welch's
// t-test. The level of all tests together is 1 %; seeds are fixed, so that a run does not differ
// from the last.
#include "host/stress/statistics.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace {

using namespace parhelion;
using nlohmann::json;

constexpr double family_level = 0.01;
constexpr int seeds = 8, samples = 128; // of each seed, a pixel
// What float sums may differ by without any noise, relative.
constexpr double rounding = 1e-5;

json read_json(const std::string& name) {
    std::ifstream in(test::source_file("tests/mitsuba/" + name));
    REQUIRE(in);
    return json::parse(in);
}

/// As the stored figures were made: with interpolated normals as they are, and rough lobes of
/// single scattering.
Scene load_case(const json& c) {
    RenderCommand command;
    command.scene_file = test::source_file("tests/mitsuba/" + c.at("scene").get<std::string>());
    json parameters = c.value("parameters", json::object());
    for (const auto& [name, value] : parameters.items())
        command.definitions.push_back(name + "=" + value.get<std::string>());
    command.samples = samples;
    command.sampler = "independent", command.filter_method = "sampling";
    command.shading_normals = "raw";
    command.energy_compensation = false;
    return test::load(command);
}

/// Mean of the picture, then of its grid x grid regions row by row.
std::vector<double> region_means(const Image& image, const std::vector<float>& values, int grid) {
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

/// Welch's test of our mean against a stored [mean, standard error] of `renders` renders.
double p_value(const stress::Mean& ours, const json& theirs, int renders) {
    double mean = theirs.at(0), error = theirs.at(1);
    double va = ours.error() * ours.error(), vb = error * error;
    double vr = std::pow(rounding * std::max(std::abs(mean), std::abs(ours.mean())), 2);
    if (va + vb + vr == 0) return ours.mean() == mean ? 1 : 0;
    double freedom = (va + vb + vr) * (va + vb + vr) /
                     (va * va / (seeds - 1) + vb * vb / (renders - 1) + 1e-300);
    return stress::student_two_sided((ours.mean() - mean) / std::sqrt(va + vb + vr),
                                     static_cast<int>(std::min(freedom, 1e4)));
}

struct Verdict {
    double least_p = 1;
    std::string where;
};

/// All regions of all channels of a case.
Verdict compare_case(const json& c, const json& stored, const json& about) {
    Scene scene = load_case(c);
    int grid = about.at("grid"), renders = about.at("renders");
    std::map<std::string, std::vector<stress::Mean>> ours;
    RenderOptions options;
    options.all_features = true; // the same programs for many cases
    for (int seed = 0; seed < seeds; seed++) {
        scene.sampler.seed = 500 + seed;
        RenderResult result = test::render_quietly(scene, options);
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
            double p = p_value(ours[name][i], figures[i], renders);
            if (p < verdict.least_p)
                verdict = {p, fmt::format("{} region {}: {:.6g} +- {:.2g} against {} +- {}", name,
                                          i, ours[name][i].mean(), ours[name][i].error(),
                                          figures[i][0].dump(), figures[i][1].dump())};
        }
    }
    return verdict;
}

std::size_t figures_in(const json& cases) {
    std::size_t count = 0;
    for (const json& c : cases)
        for (const json& channel : c.at("channels"))
            count += channel.size();
    return count;
}

json case_of_name(const json& list, const std::string& name) {
    auto found =
        std::find_if(list.begin(), list.end(), [&](const json& c) { return c.at("name") == name; });
    REQUIRE(found != list.end());
    return *found;
}

} // namespace

TEST_CASE("Pictures are Mitsuba's within the noise of both, region by region", "[render]") {
    json stored = read_json("references.json"), list = read_json("cases.json").at("cases");
    double level = stress::sidak_level(family_level, figures_in(stored.at("cases")));
    std::size_t compared = 0;
    for (const json& c : list) {
        if (c.value("mitsuba_is_wrong", false)) continue;
        std::string name = c.at("name");
        INFO(name);
        Verdict v = compare_case(c, stored.at("cases").at(name), stored.at("about"));
        fmt::print("{:<28} least p {:.1e}: {}\n", name, v.least_p, v.where);
        INFO(v.where);
        CHECK(v.least_p > level);
        compared++;
    }
    CHECK(compared == stored.at("cases").size());
}

TEST_CASE("Figures of Mitsuba's show a grey of 0.51 for 0.5, and a bounce too few", "[render]") {
    json stored = read_json("references.json"), list = read_json("cases.json").at("cases");
    double level = stress::sidak_level(family_level, figures_in(stored.at("cases")));
    for (const char* name : {"shapes", "twosided_null"}) {
        INFO(name);
        json wrong = case_of_name(list, name);
        json parameters = wrong.value("parameters", json::object());
        parameters.update(wrong.at("wrong"));
        wrong["parameters"] = parameters;
        CHECK(compare_case(wrong, stored.at("cases").at(name), stored.at("about")).least_p < level);
    }
}
