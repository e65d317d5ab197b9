// The image depends on the scene alone, to the bit: not on lanes, intrinsics, features, how work is
// split, crop or threads.
#include "host/image/exr.h"
#include "host/render/path_tracer.h"
#include "tests/support/every_kind_scene.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <unistd.h>

using namespace parhelion;
using namespace parhelion::test;

namespace {

Image image_of(const Scene& scene, const RenderOptions& options) {
    RenderResult result = render_quietly(scene, options);
    CHECK(result.report.non_finite_samples == 0);
    return result.image;
}

/// Values that differ in the window of `full` where `part` lies; every value must be a number.
int differing_values(const Image& full, const Image& part) {
    REQUIRE(full.channels.size() == part.channels.size());
    int differing = 0;
    for (std::size_t c = 0; c < full.channels.size(); c++) {
        REQUIRE(full.channels[c].name == part.channels[c].name);
        for (int y = 0; y < part.height; y++)
            for (int x = 0; x < part.width; x++) {
                int fx = x + part.offset_x - full.offset_x, fy = y + part.offset_y - full.offset_y;
                float a = full.channels[c].values[full.index(fx, fy)];
                float b = part.channels[c].values[part.index(x, y)];
                differing +=
                    std::bit_cast<unsigned>(a) != std::bit_cast<unsigned>(b) || !std::isfinite(a);
            }
    }
    return differing;
}

double mean_of(const Image& image, const char* name) {
    double sum = 0;
    for (float v : find_channel(image, name)->values)
        sum += v;
    return sum / static_cast<double>(image.pixel_count());
}

} // namespace

TEST_CASE("The image is the same bits however the work is done", "[render]") {
    Scene scene = every_kind_scene();
    Image reference = image_of(scene, {});
    CHECK(mean_of(reference, "R") > 0.05);
    CHECK(reference.channels.size() == 4 + 3 + 1 + 2 + 3 + 1 + 3);

    SECTION("two runs") { CHECK(differing_values(reference, image_of(scene, {})) == 0); }
    SECTION("another seed is another image") {
        scene.sampler.seed++;
        CHECK(differing_values(reference, image_of(scene, {})) > 1000);
    }
    SECTION("lanes, intrinsics, features") {
        for (int lanes : {16, 8, 1})
            for (bool portable : {false, true}) {
                if (lanes == 1 && portable) continue; // one lane has no intrinsics
                RenderOptions options;
                options.lanes = lanes, options.portable = portable;
                CAPTURE(lanes, portable);
                CHECK(differing_values(reference, image_of(scene, options)) == 0);
            }
        RenderOptions options;
        options.all_features = true;
        CHECK(differing_values(reference, image_of(scene, options)) == 0);
    }
    SECTION("how the work is split") {
        for (int pool : {16, 1000, 65536})
            for (int segment : {16, 100, 4096})
                for (int group : {1, 2, 7}) {
                    if (pool == 16 && group * segment > 100)
                        continue; // the same as a smaller one, and slow
                    RenderOptions options;
                    options.split = {pool, segment, group};
                    CAPTURE(pool, segment, group);
                    CHECK(differing_values(reference, image_of(scene, options)) == 0);
                }
        RenderOptions options;
        for (int streams : {1, 2, 3}) {
            options.split = {8192, 1024, 1, streams};
            CAPTURE(streams);
            CHECK(differing_values(reference, image_of(scene, options)) == 0);
        }
        options.lanes = 1;
        options.split = {1000, 37, 2};
        CHECK(differing_values(reference, image_of(scene, options)) == 0);
    }
    SECTION("crop") {
        const int windows[][4] = {{0, 0, 40, 30}, {3, 5, 17, 11}, {39, 29, 1, 1}, {8, 0, 4, 30}};
        for (bool border : {false, true})
            for (FilterMethod method : {FilterMethod::splatting, FilterMethod::sampling}) {
                scene.film.sample_border = border;
                scene.film.filter_method = method;
                Image full = image_of(scene, {});
                for (const auto& [x, y, width, height] : windows) {
                    Scene part = scene;
                    part.film.crop_x = x, part.film.crop_y = y, part.film.crop_width = width,
                    part.film.crop_height = height;
                    CAPTURE(border, int(method), x, y, width, height);
                    CHECK(differing_values(full, image_of(part, {})) == 0);
                }
            }
    }
}

TEST_CASE("A scene with fewer features gives the same bits from kernels that can do everything",
          "[render]") {
    Scene scene = every_kind_scene();
    scene.camera.aperture_radius = 0;
    scene.integrator.aovs.clear();
    scene.shapes.erase(scene.shapes.begin() + 2,
                       scene.shapes.end() - 3); // diffuse walls and area lights are left
    scene.emitters.clear();
    RenderOptions all;
    all.all_features = true;
    CHECK(differing_values(image_of(scene, {}), image_of(scene, all)) == 0);
}

TEST_CASE("The program gives the same bits on one thread and on two", "[render]") {
    namespace fs = std::filesystem;
    fs::path folder = fs::temp_directory_path() / fmt::format("parhelion-threads-{}", getpid());
    fs::create_directories(folder);
    std::vector<Image> images;
    for (int threads : {1, 2}) {
        fs::path out = folder / fmt::format("{}.exr", threads);
        std::string command =
            fmt::format("'{}' render '{}/scenes/cornell-box/scene.xml' --spp 9 --size 50x38 "
                        "--threads {} --quiet -o '{}'",
                        PARHELION_PROGRAM, PARHELION_SOURCE_DIR, threads, out.string());
        CAPTURE(command);
        REQUIRE(std::system(command.c_str()) == 0);
        images.push_back(read_exr(out.string()));
    }
    CHECK(mean_of(images[0], "R") > 0.01);
    CHECK(differing_values(images[0], images[1]) == 0);
    fs::remove_all(folder);
}
