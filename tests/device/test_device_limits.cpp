// What a device cannot take is refused before anything is compiled or launched.
#include "host/cl/work_groups.h"
#include "host/error.h"
#include "host/numerics/every_kind_scene.h"
#include "host/render/device_render.h"
#include "host/waves/stage_programs.h"
#include "tests/support/device.h"

#include <catch2/catch.hpp>

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

TEST_CASE("Film: one of which the device does not hold a few rows is refused before any work",
          "[device]") {
    TestDevice d;
    Device small = d.device;
    small.memory_bytes = std::uint64_t{1} << 20;
    RenderDevice device(small);
    Scene scene = every_kind_scene();
    scene.film.width = scene.film.crop_width = 16384;
    scene.film.height = scene.film.crop_height = 16384;
    Progress quiet(Progress::Mode::quiet);
    std::string message;
    try {
        render(scene, device, {}, quiet);
    } catch (const InputError& error) {
        message = error.what();
    }
    CHECK(message.find("4 rows of a film of 16384 pixels") != std::string::npos);
    CHECK(message.find("--crop") != std::string::npos);
}

TEST_CASE("Work-groups: the device's limit is refused with its number", "[device]") {
    TestDevice d;
    RenderDevice device(d.device);
    std::size_t most = largest_work_group(device.device);
    CHECK(most >= 1);
    CHECK(most <= d.device.handle.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>());
    for (std::size_t size : {most + 1, 2 * most, most + 100000}) {
        StageOptions options{.lanes = 1, .work_group_size = static_cast<int>(size)};
        std::string message;
        try {
            compile_stages(device, options);
        } catch (const InputError& error) {
            message = error.what();
        }
        CHECK(message.find("--work-group-size " + std::to_string(size)) == 0);
        CHECK(message.find("1 to " + std::to_string(most)) != std::string::npos);
    }
}
