// The kernels on the host look after the bounds of their buffers: a table that is shorter than a
// feature believes is told by its name, whichever of the list it is.
#include "host/twin/wave_memory.h"
#include "host/twin/work_item.h"
#include "host/waves/render_params.h"
#include "tests/support/example_sky.h"
#include "tests/support/example_textures.h"
#include "tests/support/two_of_every.h"

#include <catch2/catch.hpp>

#include <array>

using namespace parhelion;
using namespace parhelion::test;

namespace {

// One for each buffer of a scene: what takes its rows away.
void empty_bvh_nodes(DeviceScene& s) { s.bvh.nodes.clear(); }
void empty_bvh_leaves(DeviceScene& s) { s.bvh.leaves.clear(); }
void empty_primitives(DeviceScene& s) { s.geometry.primitives.resize(1); }
void empty_points(DeviceScene& s) { s.geometry.points.clear(); }
void empty_shapes(DeviceScene& s) { s.geometry.shapes.resize(1); }
void empty_materials(DeviceScene& s) { s.materials.resize(1); }
void empty_lobes(DeviceScene& s) { s.lobes.resize(1); }
void empty_material_textures(DeviceScene& s) { s.material_textures.resize(1); }
void empty_textures(DeviceScene& s) { s.textures.resize(1); }
void empty_texels(DeviceScene& s) { s.texels.clear(); }
void empty_byte_values(DeviceScene& s) { s.byte_values.clear(); }
void empty_lights(DeviceScene& s) { s.lights.clear(); }
void empty_light_nodes(DeviceScene& s) { s.light_tree.nodes.clear(); }
void empty_light_textures(DeviceScene& s) { s.light_textures.clear(); }
void empty_light_groups(DeviceScene& s) { s.light_groups.clear(); }
void empty_light_leaves(DeviceScene& s) { s.light_tree.leaves.clear(); }
void empty_environment(DeviceScene& s) { s.environment.shares.clear(); }
void empty_energy_tables(DeviceScene& s) { s.energy_tables.clear(); }
void empty_filter_table(DeviceScene& s) { s.filter_table.resize(1); }
void empty_filter_values(DeviceScene& s) { s.filter_values.clear(); }

struct Table {
    const char* name;
    void (*empty)(DeviceScene&);
};
#define TABLE(type, name) Table{#name, empty_##name},
constexpr std::array tables{SCENE_BUFFERS(TABLE)};

/// All stages over one wave of the whole film: whole tables for what the host asks of them, others
/// for the kernels.
void run_every_stage(const Scene& scene, const DeviceScene& whole, const DeviceScene& seen) {
    AovPlan aovs = plan_aovs(scene);
    WorkSplit split;
    split.streams = 1;
    WorkSizes sizes = work_sizes(film_layout(scene, aovs), 4, 1, split);
    WaveMemory<float> memory(sizes);
    HostLaunch<float> launch{scene_arrays(seen), render_params(scene, whole, sizes, aovs),
                             whole.features.on(), WaveParams{}, memory};
    set_wave(launch, Wave{{{0, sizes.blocks_per_wave, 0, 4}}});
    auto run = [&](Stage stage, int depth, int work_items) {
        for (int number = 0; number < work_items; number++)
            run_work_item(stage, launch, depth, number);
    };
    run(Stage::generate, 0, sizes.segments);
    for (int depth = 0; depth < launch.params.max_depth; depth++) {
        run(Stage::intersect, depth, sizes.segments);
        run(Stage::shade, depth, sizes.segments);
        run(Stage::shadow, depth, sizes.segments);
    }
    run(Stage::accumulate, 0, launch.wave.block_count);
}

} // namespace

TEST_CASE("Bounds: every table of a scene is looked after", "[bounds]") {
    for (const Table& table : tables) {
        CAPTURE(table.name);
        Scene scene = two_of_every();
        scene.film.filter.kind = FilterKind::gaussian;
        if (std::string(table.name) == "filter_table")
            scene.film.filter_method = FilterMethod::sampling;
        if (std::string(table.name) == "environment") put_example_sky(scene);
        if (std::string(table.name) == "lobes")
            scene.shapes[0].material_front = add_blend(scene, {0.5, 0, 1});
        if (std::string(table.name) == "light_textures")
            for (Shape& shape : scene.shapes)
                if (shape.radiance) shape.radiance_texture = example_checkerboard().texture;
        if (std::string(table.name) == "light_groups")
            scene.integrator.light_groups = {{"all", {}}};
        for (std::size_t i = 0; i < scene.materials.size(); i++)
            if (auto* matte = std::get_if<DiffuseBsdf>(&scene.materials[i].bsdf))
                matte->reflectance = example_textures[i % example_textures.size()]();
        set_energy_compensation(scene, std::string(table.name) == "energy_tables");
        DeviceScene whole = make_device_scene(scene);
        run_every_stage(scene, whole, whole);
        DeviceScene emptied = whole;
        table.empty(emptied);
        CHECK_THROWS_WITH(run_every_stage(scene, whole, emptied),
                          Catch::EndsWith(std::string("from ") + table.name + " on") ||
                              Catch::EndsWith("from no buffer on"));
    }
}

TEST_CASE("Bounds: the words of a sun are looked after", "[bounds]") {
    Scene scene = two_of_every();
    put_example_daylight(scene).sun_scale = 1;
    DeviceScene whole = make_device_scene(scene), emptied = whole;
    run_every_stage(scene, whole, whole);
    emptied.environment.shares.clear();
    CHECK_THROWS(run_every_stage(scene, whole, emptied));
}

TEST_CASE("Bounds: to the byte, and never into another buffer", "[bounds]") {
    std::array<float, 8> memory{};
    auto at = [&](int k) { return reinterpret_cast<std::uintptr_t>(memory.data() + k); };
    std::array<BufferRange, 2> buffers{BufferRange{"first", at(0), 16},
                                       BufferRange{"second", at(4), 16}};
    WorkItem item{{}, 0, buffers};
    float* first = memory.data();
    for (int k = 0; k < 4; k++)
        CHECK(item.inside(first, first + k, sizeof(float)) == first + k);
    CHECK(item.inside(first, first, 16) == first);
    CHECK_THROWS_WITH(item.inside(first, first + 4, sizeof(float)),
                      Catch::Contains("from first on"));
    CHECK_THROWS_WITH(item.inside(first, first + 1, 16), Catch::Contains("from first on"));
    CHECK_THROWS_WITH(item.inside(first + 5, first + 3, 4), Catch::Contains("from second on"));
    CHECK_THROWS_WITH(item.inside(first + 9, first + 9, 4), Catch::Contains("from no buffer on"));
    CHECK(WorkItem{}.inside(first, first + 99, 4) == first + 99);
}
