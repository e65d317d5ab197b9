// The kernels compiled as C++ give the image that the device gives, to the bit, in all channels.
#include "host/numerics/every_kind_scene.h"
#include "tests/support/host_render.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

Image host_image(const Scene& scene, const RenderOptions& options = {}) {
    return host_render(scene, Precision::single_precision, options).image;
}

Scene scene_of(const std::string& file, int width, int height, int samples) {
    RenderCommand command;
    command.scene_file = source_file("scenes/" + file);
    command.samples = samples;
    command.size = fmt::format("{}x{}", width, height);
    return load(command);
}

} // namespace

TEST_CASE("The kernels as C++ give the device's bits", "[render]") {
    Scene scene = every_kind_scene();
    scene.sampler.samples_per_pixel = 5;
    scene.integrator.aovs = {{"al", "albedo", {}},      {"nn", "sh_normal", {}},
                             {"ng", "geo_normal", {}},  {"pp", "position", {}},
                             {"uv", "uv", {}},          {"dd", "depth", {}},
                             {"si", "shape_index", {}}, {"pi", "prim_index", {}}};
    SECTION("splatted samples") {
        Image device = render_quietly(scene).image;
        CHECK(differing_values(device, host_image(scene)).differing == 0);
        RenderOptions options;
        options.split = {1000, 37, 2};
        options.all_features = true;
        CHECK(differing_values(device, host_image(scene, options)).differing == 0);
        scene.sampler.seed++;
        CHECK(differing_values(device, host_image(scene)).differing > 1000);
    }
    SECTION("samples placed by the filter, independent ones") {
        scene.film.filter_method = FilterMethod::sampling;
        scene.sampler.pattern = SamplePattern::independent;
        CHECK(differing_values(render_quietly(scene).image, host_image(scene)).differing == 0);
    }
    SECTION("views") {
        for (IntegratorKind kind : {IntegratorKind::normals, IntegratorKind::direct}) {
            scene.integrator.kind = kind;
            CAPTURE(int(kind));
            CHECK(differing_values(render_quietly(scene).image, host_image(scene)).differing == 0);
        }
    }
}

TEST_CASE("The kernels as C++ give the device's bits of scene files", "[render]") {
    for (const char* file : {"glass-and-metal/scene.xml", "cornell-box/scene.xml"}) {
        CAPTURE(file);
        Scene scene = scene_of(file, 40, 30, 4);
        CHECK(differing_values(render_quietly(scene).image, host_image(scene)).differing == 0);
    }
}
