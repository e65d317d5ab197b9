// The kernels on the host look after the bounds of their buffers: a table that is shorter than a
// feature believes is told by its name, whichever of the list it is.
#include "host/oracle/sample_trace.h"
#include "host/oracle/work_item.h"
#include "tests/support/two_of_every.h"

#include <catch2/catch.hpp>

#include <array>

using namespace parhelion;
using namespace parhelion::test;

namespace {

// One for each buffer of a scene: what takes its rows away.
void empty_bvh_nodes(DeviceScene& s) { s.bvh.nodes.clear(); }
void empty_bvh_leaves(DeviceScene& s) { s.bvh.leaves.clear(); }
void empty_primitives(DeviceScene& s) { s.primitives.resize(1); }
void empty_vertices(DeviceScene& s) { s.vertices.clear(); }
void empty_materials(DeviceScene& s) { s.materials.resize(1); }
void empty_lights(DeviceScene& s) { s.lights.clear(); }
void empty_light_nodes(DeviceScene& s) { s.light_tree.nodes.clear(); }
void empty_light_leaves(DeviceScene& s) { s.light_tree.leaves.clear(); }
void empty_energy_tables(DeviceScene& s) { s.energy_tables.clear(); }
void empty_filter_table(DeviceScene& s) { s.filter_table.resize(1); }
void empty_filter_values(DeviceScene& s) { s.filter_values.clear(); }

struct Table {
    const char* name;
    void (*empty)(DeviceScene&);
};
#define TABLE(type, name) Table{#name, empty_##name},
constexpr std::array tables{SCENE_BUFFERS(TABLE)};

void trace_every_pixel(const Scene& scene, const DeviceScene& flat) {
    for (int y = 0; y < scene.film.height; y++)
        for (int x = 0; x < scene.film.width; x++)
            for (int sample = 0; sample < 4; sample++)
                trace_sample(scene, flat, x, y, sample);
}

} // namespace

TEST_CASE("Bounds: every table of a scene is looked after", "[bounds]") {
    for (const Table& table : tables) {
        CAPTURE(table.name);
        Scene scene = two_of_every();
        scene.film.filter.kind = FilterKind::gaussian;
        if (std::string(table.name) == "filter_table")
            scene.film.filter_method = FilterMethod::sampling;
        set_energy_compensation(scene, std::string(table.name) == "energy_tables");
        DeviceScene flat = make_device_scene(scene);
        trace_every_pixel(scene, flat);
        table.empty(flat);
        CHECK_THROWS_WITH(trace_every_pixel(scene, flat),
                          Catch::EndsWith(std::string("from ") + table.name + " on") ||
                              Catch::EndsWith("from no buffer on"));
    }
}

TEST_CASE("Bounds: to the byte, and never into another buffer", "[bounds]") {
    std::array<float, 8> memory{};
    auto at = [&](int k) { return reinterpret_cast<std::uintptr_t>(memory.data() + k); };
    std::array<BufferRange, 2> buffers{BufferRange{"first", at(0), 16},
                                       BufferRange{"second", at(4), 16}};
    WorkItem item{0, 0, buffers};
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
