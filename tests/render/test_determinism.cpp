// The image depends on the scene alone, to the bit: not on threads or what kernels can do besides.
// How work is split, lanes, crops: rows `splitting`, `kernels`, `crops`
// of the catalogue.
#include "host/image/exr.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/image_figures.h"
#include "host/render/device_render.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <unistd.h>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

Image image_of(const Scene& scene, const RenderOptions& options) {
    RenderResult result = render_quietly(scene, options);
    CHECK(result.report.non_finite_samples == 0);
    return result.image;
}

std::uint64_t differing(const Image& full, const Image& part) {
    return numerics::differing_values(full, part).differing;
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

    SECTION("two runs") { CHECK(differing(reference, image_of(scene, {})) == 0); }
    SECTION("another seed is another image") {
        scene.sampler.seed++;
        CHECK(differing(reference, image_of(scene, {})) > 1000);
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
    CHECK(differing(image_of(scene, {}), image_of(scene, all)) == 0);
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
    CHECK(differing(images[0], images[1]) == 0);
    fs::remove_all(folder);
}
