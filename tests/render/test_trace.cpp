// A sample told vertex by vertex is the sample that the device renders.
#include "host/commands/trace_report.h"
#include "host/film/film_image.h"
#include "host/numerics/every_kind_scene.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

bool same_bits(float a, float b) {
    return std::bit_cast<unsigned>(a) == std::bit_cast<unsigned>(b);
}

/// The sum of what the vertices say they add, in the order of the kernels.
Triple sum_of(const SampleTrace& trace) {
    Triple sum{};
    for (const TraceVertex& v : trace.vertices)
        for (int c = 0; c < 3; c++)
            sum[c] += v.emission[c] + (v.shadow_ray && !v.blocked ? v.light[c] : 0.f);
    return sum;
}

/// A box filter and one sample: a pixel is its sample.
Scene one_sample_scene() {
    Scene scene = every_kind_scene();
    scene.film.filter.kind = FilterKind::box;
    scene.sampler.samples_per_pixel = 1;
    scene.integrator.second_moment = false;
    std::erase_if(scene.integrator.aovs, is_film_aov); // one sample has no variance
    return scene;
}

} // namespace

TEST_CASE("The trace of a sample adds up to its pixel", "[render]") {
    Scene scene = one_sample_scene();
    Image image = render_quietly(scene).image;
    DeviceScene flat = make_device_scene(scene);
    int differing = 0, blocked = 0, arrives = 0, roulettes = 0, emission = 0;
    double error = 0;
    for (int y = 0; y < scene.film.height; y++)
        for (int x = 0; x < scene.film.width; x++) {
            SampleTrace trace = trace_sample(scene, flat, x, y, 0);
            Triple sum = sum_of(trace);
            for (int c = 0; c < 3; c++) {
                float pixel =
                    find_channel(image, std::string(1, "RGB"[c]))->values[image.index(x, y)];
                differing += !same_bits(trace.radiance[c], pixel);
                error = std::max(error, std::abs(double{sum[c]} - pixel) / (1e-3 + pixel));
            }
            differing +=
                !same_bits(trace.alpha, find_channel(image, "A")->values[image.index(x, y)]);
            CHECK(trace.first_not_finite == -1);
            for (const TraceVertex& v : trace.vertices) {
                blocked += v.shadow_ray && v.blocked;
                arrives += v.shadow_ray && !v.blocked;
                roulettes += v.notes.roulette.has_value();
                emission += v.notes.emission_weight.has_value();
            }
        }
    CHECK(differing == 0);
    CHECK(error < 1e-5);
    CHECK(std::min({blocked, arrives, roulettes, emission}) > 50);
}

TEST_CASE("The trace tells what a point light over a plane does", "[render]") {
    RenderCommand command;
    command.scene_file = source_file("scenes/closed_form/point_light_over_plane/scene.xml");
    Scene scene = load(command);
    DeviceScene flat = make_device_scene(scene);
    const auto& light = std::get<PointEmitter>(scene.emitters[0]);
    const auto& bsdf = std::get<DiffuseBsdf>(scene.materials[0].bsdf);
    SampleTrace trace = trace_sample(scene, flat, 3, 2, 0);
    REQUIRE(!trace.vertices.empty());
    const TraceVertex& v = trace.vertices[0];
    REQUIRE(v.hit);
    const Triple& p = v.notes.surface->position;
    glm::dvec3 in_scene = glm::dvec3(p[0], p[1], p[2]) * flat.frame.unit() + flat.frame.centre();
    glm::dvec3 to = light.position - in_scene;
    const Triple& n = v.notes.surface->ns;
    double cosine = std::abs(glm::dot(glm::normalize(to), glm::dvec3(n[0], n[1], n[2])));
    double expected = bsdf.reflectance.constant.r / std::numbers::pi * light.intensity.r * cosine /
                      glm::dot(to, to);
    CHECK(v.light[0] == Approx(expected).epsilon(1e-6));
    CHECK(v.notes.pick->pmf == 1.f);
    CHECK(v.shadow_ray);
    CHECK(!v.blocked);
    CHECK(trace.radiance[0] == v.light[0]);
    std::string text = trace_text(trace_json(scene, flat, trace));
    CHECK(text.find("light        point 0, picked with 1") != std::string::npos);
}

TEST_CASE("The trace names the vertex where a sample stops being finite", "[render]") {
    Scene scene = one_sample_scene();
    std::get<DiffuseBsdf>(scene.materials[0].bsdf).reflectance = Rgb(1e25);
    DeviceScene flat = make_device_scene(scene);
    int found = 0;
    for (int x = 0; x < scene.film.width; x++) {
        SampleTrace trace = trace_sample(scene, flat, x, 28, 0);
        if (!trace.left_out) continue;
        found++;
        REQUIRE(trace.first_not_finite >= 0);
        CHECK(trace.left_out->bounce == trace.first_not_finite);
        nlohmann::json json = trace_json(scene, flat, trace);
        CHECK(json["first_not_finite_vertex"] == trace.first_not_finite);
        CHECK(trace_text(json).find("here for the first time") != std::string::npos);
        CHECK(trace_text(json).find("left out of the image") != std::string::npos);
    }
    CHECK(found > 0);
}

TEST_CASE("What cannot be traced is refused in one line", "[render]") {
    RenderCommand command;
    command.scene_file = source_file("scenes/cornell-box/scene.xml");
    command.trace = true;
    command.pixel = "512,0", command.sample = 0;
    CHECK_THROWS_WITH(run_render(command),
                      "--pixel '512,0': must lie inside the film of 512x512 pixels");
    command.pixel = "1;2";
    CHECK_THROWS_WITH(run_render(command), "--pixel '1;2': expected X,Y, e.g. 12,34");
    command.pixel = "511,0", command.sample = 64;
    CHECK_THROWS_WITH(run_render(command), "--sample 64: a pixel has samples 0 to 63 (--spp)");
    command.sample = 0, command.output = "image.exr";
    CHECK_THROWS_WITH(run_render(command), "--trace: renders no image, so --output, --exposure and "
                                           "--stats are of no use with it");
    command.output = RenderCommand{}.output, command.json_file = command.scene_file;
    std::string exists = command.scene_file + ": exists; give --force to replace it";
    CHECK_THROWS_WITH(run_render(command), exists);
    command.trace = false, command.stats_file = command.json_file;
    command.output = "no-such-image.exr";
    CHECK_THROWS_WITH(run_render(command), exists);
}
