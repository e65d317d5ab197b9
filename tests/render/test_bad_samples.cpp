// No silent bad sample: what is not finite is left out, counted by the stage that made it, and
// located, the same however the work is split.
#include "host/commands/bad_sample_warning.h"
#include "host/numerics/every_kind_scene.h"
#include "host/render/host_render.h"
#include "host/twin/sample_trace.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;
using Catch::Contains;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr int samples = 20; // a group and a rest

/// A floor that fills the view, and before it a square of material 1, lit from the camera's side.
Scene square_scene() {
    Scene scene;
    scene.file = "made by the test";
    scene.materials = {{"", {}, DiffuseBsdf{Rgb(0.5)}}, {"", {}, DiffuseBsdf{Rgb(0.5)}}};
    scene.shapes.push_back(shape_of(quad({-9, -9, -1}, {18, 0, 0}, {0, 18, 0}), 0, 0));
    scene.shapes.push_back(shape_of(quad({-0.7, 0.1, 0}, {1.8, 0, 0}, {0, 0.9, 0}), 1, 1));
    scene.emitters = {PointEmitter{{0, 0, 5}, Rgb(30)}};
    scene.camera.to_world = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                       glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 0, 4, 1));
    scene.film.width = scene.film.crop_width = 23;
    scene.film.height = scene.film.crop_height = 17;
    scene.film.filter.kind = FilterKind::box;
    scene.integrator.max_depth = 2;
    scene.sampler.samples_per_pixel = samples;
    return scene;
}

/// Samples of each pixel that see the square; the first of them all, by sample and then by pixel.
struct Seen {
    std::vector<double> counts;
    double total = 0;
};

Seen square_seen(Scene scene) {
    scene.integrator.aovs = {{"shape", "shape_index", {}}};
    Image image = render_quietly(scene).image;
    Seen seen;
    for (float mean : find_channel(image, "shape.I")->values) { // 1 floor, 2 square
        seen.counts.push_back(std::round((mean - 1.0) * samples));
        seen.total += seen.counts.back();
    }
    return seen;
}

std::uint64_t count_of(const RenderReport& report, const std::string& fault) {
    std::uint64_t count = 0;
    for (const FaultCount& f : report.faults)
        if (f.fault == fault) count += f.samples;
    return count;
}

} // namespace

TEST_CASE("A material that is not finite: every sample that sees it is left out, counted, located",
          "[render]") {
    Scene scene = square_scene();
    Seen seen = square_seen(scene);
    REQUIRE(seen.total > 100);
    Image good = render_quietly(scene).image;
    scene.materials[1].bsdf = DiffuseBsdf{Rgb(0.5, 0.5, none)};
    scene.integrator.aovs = {{"samples", "samples", {}}};
    RenderResult result = render_quietly(scene);
    CHECK(result.report.non_finite_samples == seen.total);
    CHECK(count_of(result.report, "next_event") == seen.total);
    REQUIRE_FALSE(result.report.bad_samples.empty());
    const std::vector<float>& counted = find_channel(result.image, "samples.N")->values;
    for (std::size_t i = 0; i < counted.size(); i++) {
        CHECK(counted[i] == samples - seen.counts[i]);
        for (const Channel& channel : result.image.channels)
            CHECK(std::isfinite(channel.values[i]));
        if (seen.counts[i] == 0)
            CHECK(find_channel(result.image, "B")->values[i] == find_channel(good, "B")->values[i]);
    }
    for (const BadSample& bad : result.report.bad_samples) {
        CHECK(seen.counts[good.index(bad.x, bad.y)] > 0);
        CHECK(bad.bounce == 0);
        CHECK(std::string(bad.fault_name()) == "next_event");
    }
    const BadSample& first = result.report.bad_samples[0];
    CHECK(first.sample == 0); // the square covers whole pixels
    for (std::size_t i = 0; i < good.index(first.x, first.y); i++)
        CHECK(seen.counts[i] < samples);
}

TEST_CASE("Bad samples are told apart by what went wrong", "[render]") {
    Scene scene = square_scene();
    std::string fault = "emission";
    int bounce = 0;
    SECTION("more light than a number holds") {
        scene.materials[1].bsdf = ConductorBsdf{{Rgb(1), Rgb(1)}, Rgb(1, 1e38, 1)};
        scene.integrator.max_depth = 3;
        scene.emitters = {ConstantEmitter{Rgb(1e6)}};
        scene.integrator.emitter_samples = false;
        bounce = 1;
    }
    SECTION("a camera nowhere") {
        scene.camera.to_world[2][0] = none;
        fault = "camera_ray";
    }
    SECTION("a throughput") {
        scene.materials[1].bsdf = ConductorBsdf{{Rgb(1), Rgb(1)}, Rgb(none, 1, 1)};
        scene.integrator.max_depth = 3;
        scene.emitters = {ConstantEmitter{Rgb(1)}};
        scene.integrator.emitter_samples = false;
        fault = "bsdf";
    }
    RenderResult result = render_quietly(scene);
    CHECK(result.report.non_finite_samples > 0);
    CHECK(count_of(result.report, fault) == result.report.non_finite_samples);
    REQUIRE_FALSE(result.report.bad_samples.empty());
    const std::vector<BadSample>& bad = result.report.bad_samples;
    CHECK(std::any_of(bad.begin(), bad.end(),
                      [&](const BadSample& b) { return b.bounce == bounce; }));
    for (const Channel& channel : result.image.channels)
        for (float v : channel.values)
            if (!std::isfinite(v)) FAIL(channel.name);
}

TEST_CASE("Bad samples are the same however the work is split", "[render]") {
    Scene scene = every_kind_scene();
    scene.sampler.samples_per_pixel = 40;
    scene.materials[4].bsdf = DiffuseBsdf{Rgb(none, 0.5, 0.5)};
    auto faults_of = [](const RenderReport& r) {
        nlohmann::json report = to_json(r);
        return nlohmann::json{report["faults"], report["bad_samples"]};
    };
    nlohmann::json expected;
    RenderOptions options[] = {{}, {}, {}, {}, {}};
    options[1].lanes = 8;
    options[2].lanes = 1, options[2].split = {1000, 37, 2, 1};
    options[3].split = {256, 16, 1, 3};
    options[4].portable = true, options[4].split = {8192, 1024, 1, 2};
    for (const RenderOptions& option : options) {
        nlohmann::json found = faults_of(render_quietly(scene, option).report);
        if (expected.is_null()) expected = found;
        CHECK(found[1].size() == 16);
        CHECK(found == expected);
    }
    Progress quiet(Progress::Mode::quiet);
    auto on_host = [&](Precision p) { return render_on_host(scene, {}, p, quiet).report; };
    CHECK(faults_of(on_host(Precision::single_precision)) == expected);
    RenderReport twice = on_host(Precision::double_precision);
    CHECK(twice.bad_samples.size() == 16);
    for (const auto& [stage, fault, samples] : twice.faults)
        CHECK(stage == "shade");
}

TEST_CASE("The trace of a bad sample says what the report says", "[render]") {
    Scene scene = every_kind_scene();
    scene.sampler.samples_per_pixel = 4;
    scene.materials[4].bsdf = DiffuseBsdf{Rgb(none, 0.5, 0.5)};
    DeviceScene flat = make_device_scene(scene);
    RenderReport report = render_quietly(scene).report;
    REQUIRE(report.bad_samples.size() > 4);
    for (const BadSample& bad : report.bad_samples) {
        SampleTrace trace = trace_sample(scene, flat, bad.x, bad.y, bad.sample);
        REQUIRE(trace.left_out);
        CHECK(trace.left_out->x == bad.x);
        CHECK(trace.left_out->y == bad.y);
        CHECK(trace.left_out->sample == bad.sample);
        CHECK(trace.left_out->fault == bad.fault);
        CHECK(trace.left_out->bounce == bad.bounce);
        CHECK(trace.first_not_finite == bad.bounce);
        CHECK(std::isnan(trace.weight));
    }
}

TEST_CASE("The warning names stage, place and the command to follow the sample", "[render]") {
    RenderCommand command;
    command.scene_file = "my scene.xml";
    command.definitions = {"light=bright"};
    command.seed = 7, command.samples = 64, command.size = "32x16";
    command.energy_compensation = false, command.shading_normals = "raw";
    command.aovs = {"albedo", "depth"};
    RenderReport report;
    CHECK(bad_sample_warning(command, report).empty());
    report.non_finite_samples = 5;
    report.faults = {{"shade", "emission", 2}, {"shade", "bsdf", 3}};
    report.bad_samples = {{3, 4, 5, fault_bsdf, 2}};
    std::string text = bad_sample_warning(command, report);
    CHECK_THAT(text, Contains("5 samples were not finite") && Contains("2 in shade (emission)") &&
                         Contains("3 in shade (bsdf)") &&
                         Contains("pixel 3,4 sample 5: shade (bsdf, bounce 2)"));
    CHECK_THAT(text, Contains("parhelion render 'my scene.xml' --pixel 3,4 --sample 5 --trace "
                              "--spp 64 --size 32x16 --seed 7 --shading-normals raw "
                              "--no-energy-compensation --aov albedo,depth --define light=bright"));
}
