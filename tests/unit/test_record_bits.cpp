// What records derive from their own words is derived from those words, rounded as they are: the
// same bits from every compiler.
#include "host/flatten/device_scene.h"
#include "tests/support/single_primitives.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace parhelion;

namespace {

/// 64 triangles whose corners are no floats.
Scene scene_of_triangles() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-711.68, 1431.55);
    Mesh mesh;
    for (unsigned i = 0; i < 192; i++)
        mesh.positions.emplace_back(place(random), place(random), place(random));
    for (unsigned i = 0; i < 192; i += 3)
        mesh.triangles.emplace_back(i, i + 1, i + 2);
    Scene scene;
    scene.materials.emplace_back();
    Shape shape;
    shape.geometry = mesh;
    scene.shapes.push_back(shape);
    return scene;
}

/// Its words as doubles, which no compiler may see through.
struct Corner {
    volatile float x, y, z;
};

double length_of_normal(const PrimitiveRecord& p) {
    const Corner a{p.ax, p.ay, p.az}, b{p.bx, p.by, p.bz}, c{p.cx, p.cy, p.cz};
    const double ux = double{b.x} - double{a.x}, uy = double{b.y} - double{a.y},
                 uz = double{b.z} - double{a.z}, vx = double{c.x} - double{a.x},
                 vy = double{c.y} - double{a.y}, vz = double{c.z} - double{a.z};
    const double x = uy * vz - vy * uz, y = uz * vx - vz * ux, z = ux * vy - vx * uy;
    return std::sqrt(x * x + y * y + z * z);
}

} // namespace

TEST_CASE("A triangle's record holds the length of its own normal", "[unit]") {
    const DeviceScene flat = make_device_scene(scene_of_triangles());
    REQUIRE(flat.geometry.primitives.size() == 64);
    for (const PrimitiveRecord& p : test::single_primitives(flat.geometry))
        CHECK(p.extra == static_cast<float>(1.0 / length_of_normal(p)));
}
