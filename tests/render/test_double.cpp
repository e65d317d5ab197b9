// The kernels in double precision are the oracle of the device's rounding: same scene, same random
// numbers, so that images differ by rounding, and where a path takes another way for it.
#include "host/numerics/every_kind_scene.h"
#include "tests/support/host_render.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <cmath>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

Image double_image(const Scene& scene) {
    RenderResult result = host_render(scene, Precision::double_precision);
    CHECK(result.report.non_finite_samples == 0);
    return result.image;
}

Scene scene_of(const std::string& file, const std::string& size, int samples) {
    RenderCommand command;
    command.scene_file = source_file("scenes/" + file);
    command.size = size;
    command.samples = samples;
    return load(command);
}

/// Values that differ by rounding, and those of pixels where a path went another way for it. The
/// latter are few, and as often brighter as darker; how far off one of them is says nothing.
struct Difference {
    double mean = 0;          ///< of the single from the double, relative, where rounding is all
    double farther_share = 0; ///< of values that are farther off than `bound` of themselves
    double farther_z = 0;     ///< their sum over its standard error, were either sign as likely
};

Difference difference(const Image& single, const Image& twice, double bound) {
    Difference d;
    double sum = 0, farther = 0, farther_squares = 0;
    std::size_t count = 0;
    for (int c = 0; c < 3; c++) {
        std::string name(1, "RGB"[c]);
        const auto& a = find_channel(single, name)->values;
        const auto& b = find_channel(twice, name)->values;
        for (std::size_t i = 0; i < a.size(); i++) {
            double off = double{a[i]} - b[i];
            sum += b[i];
            if (std::abs(off) <= bound * std::abs(b[i])) {
                d.mean += off;
            } else {
                d.farther_share++;
                farther += off, farther_squares += off * off;
            }
        }
        count += a.size();
    }
    d.mean /= sum, d.farther_share /= static_cast<double>(count);
    if (farther_squares > 0) d.farther_z = farther / std::sqrt(farther_squares);
    return d;
}

/// For the colours of a pixel, which go together: three are one, so that 6 is 3.5.
constexpr double most_z = 6;

} // namespace

TEST_CASE("Single precision is off double by its rounding", "[render]") {
    constexpr double u = 0x1p-24;
    // Edges of the longest path; a vertex rounds what it multiplies a path by some 60 times, of
    // which the square root is usual.
    struct Case {
        const char* file;
        int edges;
    };
    for (Case c :
         {Case{"closed_form/point_light_over_plane/scene.xml", 2},
          Case{"closed_form/directional_light/scene.xml", 2},
          Case{"closed_form/conductor_reflectance/scene.xml", 2},
          Case{"closed_form/facing_mirrors/scene.xml", 8}, Case{"cornell-box/scene.xml", 8}}) {
        CAPTURE(c.file);
        Scene scene = scene_of(c.file, "24x24", 16);
        Difference d =
            difference(render_quietly(scene).image, double_image(scene), 60 * u * c.edges);
        CHECK(std::abs(d.mean) < 8 * u * c.edges);
        CHECK(d.farther_share < 0.01);
        CHECK(std::abs(d.farther_z) < most_z);
    }
}

TEST_CASE("An enclosure whose every number is a power of two has no rounding in double",
          "[render]") {
    Scene scene = scene_of("closed_form/enclosure_half/scene.xml", "4x4", 16);
    scene.integrator.emitter_samples = false;
    Image image = double_image(scene);
    for (float v : find_channel(image, "R")->values)
        CHECK(v == 2.f - 0x1p-11f);
}

TEST_CASE("Every kind of thing is the same to double but for few paths", "[render]") {
    Scene scene = every_kind_scene();
    scene.sampler.samples_per_pixel = 256; // of few samples one path that goes another way shows
    Image single = render_quietly(scene).image;
    Image twice = double_image(scene);
    Difference d = difference(single, twice, 1e-4);
    CHECK(std::abs(d.mean) < 1e-6);
    CHECK(d.farther_share < 0.1);
    CHECK(std::abs(d.farther_z) < most_z);
    REQUIRE(single.channels.size() == twice.channels.size());

    tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    Image alone = double_image(scene);
    for (std::size_t c = 0; c < twice.channels.size(); c++)
        CHECK(alone.channels[c].values == twice.channels[c].values);
}

TEST_CASE("Which precision is asked for is checked", "[render]") {
    RenderCommand command;
    command.scene_file = source_file("scenes/cornell-box/scene.xml");
    command.output = "never-written.exr";
    command.precision = "half";
    CHECK_THROWS_WITH(run_render(command), "--precision 'half': there are single, double");
    command.precision = "double", command.device = "0";
    CHECK_THROWS_WITH(run_render(command), "--device: double precision runs on the host");
}
