// Kernels that look after the bounds of their buffers: on the host, where they always do, with all
// scene files of the repository; on the device they leave none, and make the same image.
#include "host/film/film_image.h"
#include "host/waves/device_waves.h"
#include "host/waves/render_params.h"
#include "tests/support/every_switch.h"
#include "tests/support/host_render.h"
#include "tests/support/render_scene.h"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace parhelion;
using namespace parhelion::test;

namespace {

void check_bounds(const Scene& scene, int lanes) {
    RenderOptions checked;
    checked.checked = true;
    checked.lanes = lanes;
    checked.split = {.pool_paths = 1000, .segment_paths = 64};
    Image image = render_quietly(scene, checked).image;
    Image host = host_render(scene, Precision::single_precision).image;
    CHECK(differing_values(host, image).differing == 0);
}

/// The buffer that the first bounce leaves where a device has this scene, by checked kernels.
const char* left_buffer(const Scene& scene, const DeviceScene& flat) {
    RenderDevice& device = test_device();
    StageOptions options;
    options.lanes = 16, options.features = flat.features.on(), options.checked = true;
    DeviceWaves waves(device, options);
    AovPlan aovs = plan_aovs(scene);
    WorkSplit split;
    split.streams = 1;
    WorkSizes sizes =
        work_sizes(film_layout(scene, aovs), scene.sampler.samples_per_pixel, 16, split);
    waves.upload(flat);
    waves.allocate(std::span(&sizes, 1),
                   [&](const WorkSizes& s) { return render_params(scene, flat, s, aovs); });
    WaveStream& stream = waves.streams().front();
    stream.begin_wave({{{0, sizes.blocks_per_wave, 0, sizes.samples_per_wave}}});
    for (Stage stage : {Stage::generate, Stage::intersect, Stage::shade})
        stream.launch(stage, 0, sizes.segments);
    stream.end_wave();
    return stream.read_outside();
}

/// Below a folder of the repository.
std::vector<std::string> scene_files(const std::string& folder) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source_file(folder)))
        if (entry.path().extension() == ".xml" &&
            entry.path().parent_path().filename() != "parts") // included by others
            files.push_back(entry.path());
    return files;
}

/// As a render of it would be, but small; nothing where the scene needs files that are elsewhere.
std::optional<Scene> small_scene(const std::string& file) {
    RenderCommand command;
    command.scene_file = file;
    command.size = "8x6";
    command.samples = 2;
    try {
        return load(command);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

} // namespace

TEST_CASE("Checked kernels of the host: all scene files", "[render]") {
    int rendered = 0;
    for (const char* folder : {"scenes", "tests/mitsuba/scenes"})
        for (const std::string& file : scene_files(folder)) {
            CAPTURE(file);
            auto scene = small_scene(file);
            if (!scene) continue;
            CHECK_NOTHROW(host_render(*scene, Precision::single_precision));
            CHECK_NOTHROW(host_render(*scene, Precision::double_precision));
            rendered++;
        }
    CHECK(rendered > 45);
}

TEST_CASE("Checked kernels of a device: everything, nothing and no power", "[render]") {
    Scene all = two_of_every();
    set_energy_compensation(all, true);
    all.integrator.aovs = {{"uv", "uv", {}}, {"variance", "variance", {}}};
    all.film.filter.kind = FilterKind::gaussian;
    Scene empty = objects_scene();
    empty.shapes.clear(), empty.materials.clear();
    Scene dark = objects_scene();
    for (const LightKind& kind : light_kinds)
        kind.add(dark, 0, Rgb(0), Where::room);
    Scene seen = panel_scene();
    seen.integrator.max_depth = 1;
    check_bounds(all, 16), check_bounds(all, 1);
    check_bounds(empty, 16), check_bounds(dark, 16), check_bounds(seen, 16);
}

TEST_CASE("Checked kernels of a device tell of a table that is shorter than a feature believes",
          "[render]") {
    Scene seen = panel_scene();
    seen.integrator.max_depth = 1;
    DeviceScene flat = make_device_scene(seen);
    CHECK(left_buffer(seen, flat) == nullptr);
    flat.lights.clear();
    const char* name = left_buffer(seen, flat);
    REQUIRE(name != nullptr);
    CHECK(name == std::string("lights"));
}
