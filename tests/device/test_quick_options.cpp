// The compiler options that only save time: every stage compiles with them, and computes the same.
#include "host/numerics/every_kind_scene.h"
#include "host/render/device_render.h"
#include "host/waves/stages.h"
#include "tests/support/device.h"
#include "tests/support/skip.h"

#include <catch2/catch.hpp>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

std::vector<float> rendered(const Device& device) {
    Scene scene = every_kind_scene();
    scene.film.width = scene.film.crop_width = 16, scene.film.height = scene.film.crop_height = 12;
    scene.sampler.samples_per_pixel = 2;
    Progress quiet(Progress::Mode::quiet);
    RenderDevice opened(device);
    return find_channel(render(scene, opened, {}, quiet).image, "R")->values;
}

} // namespace

TEST_CASE("Every stage compiles with the options that save time", "[device]") {
    TestDevice d;
    if (d.device.quick_options.empty()) {
        skip("this device's compiler has no options that save time");
        return;
    }
    std::vector<std::string> files;
    files.reserve(stage_count);
    for (const char* stage : stage_names)
        files.push_back(std::string(stage) + ".cl");
    for (const Variant& variant : variants) {
        CAPTURE(variant.name());
        ProgramSource source =
            program_source(files, {variant.lanes, FeatureSet::all(), variant.portable});
        cl::Program program(d.context, source.text);
        std::string options = source.options + " " + d.device.quick_options;
        CHECK_NOTHROW(program.build({d.device.handle}, options.c_str()));
    }
}

TEST_CASE("Each stage compiles by itself", "[device]") {
    TestDevice d;
    for (const char* stage : stage_names) {
        CAPTURE(stage);
        ProgramSource source =
            program_source({std::string(stage) + ".cl"}, {d.device.lanes(), FeatureSet{}, false});
        cl::Program program(d.context, source.text);
        CHECK_NOTHROW(program.build({d.device.handle}, source.options.c_str()));
    }
}

TEST_CASE("The options that save time change no bit", "[device]") {
    Device device = choose_device("");
    std::vector<float> quick = rendered(device);
    device.quick_options.clear();
    CHECK(rendered(device) == quick);
}
