// Two triangles that are one lamp: found whichever way their corners are numbered, and only where
// they are a parallelogram facing one way.
#include "host/flatten/device_scene.h"
#include "host/flatten/parallelograms.h"
#include "host/numerics/every_kind_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace parhelion;

namespace {

using Corners = std::array<glm::dvec3, 3>;
const glm::dvec3 a(0.25, 1, -3), b(2, 1.5, -3), c(0.5, 4, -2.5), d = b + c - a;

Corners rotated(const Corners& t, int by) { return {t[by], t[(by + 1) % 3], t[(by + 2) % 3]}; }

} // namespace

TEST_CASE("Parallelograms: found whichever corner comes first") {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            auto found = parallelogram_of(rotated({a, b, c}, i), rotated({d, c, b}, j));
            REQUIRE(found);
            CHECK((*found == Parallelogram{a, b, c}));
        }
    // Cut along the other diagonal the corners have other names, and it faces the same way.
    auto other = parallelogram_of({b, d, a}, {c, a, d});
    REQUIRE(other);
    CHECK((*other == Parallelogram{b, d, a}));
}

TEST_CASE("Parallelograms: refused where there is none") {
    CHECK_FALSE(parallelogram_of({a, b, c}, {d, b, c}));        // faces the other way
    CHECK_FALSE(parallelogram_of({a, b, c}, {a, b, c}));        // the same triangle twice
    CHECK_FALSE(parallelogram_of({a, b, c}, {d + 1e-4, c, b})); // another quadrilateral
    CHECK_FALSE(parallelogram_of({a, b, c}, {d, d + a, d + b}));
    CHECK(parallelogram_of({a, b, c}, {d + 1e-7, c, b})); // rounding to single precision
}

TEST_CASE("Parallelograms: a quad is one light that both its triangles name, of its whole area; a "
          "triangle beside it is another") {
    Scene scene = numerics::every_kind_scene();
    DeviceScene flat = make_device_scene(scene);
    auto is_quad = [](const LightRecord& l) { return l.kind == emitter_area_parallelogram; };
    auto quad = std::find_if(flat.lights.begin(), flat.lights.end(), is_quad);
    REQUIRE(quad != flat.lights.end());
    CHECK(std::count_if(flat.lights.begin(), flat.lights.end(), is_quad) == 1);
    int row = static_cast<int>(quad - flat.lights.begin());
    const auto& primitives = flat.geometry.primitives;
    CHECK(std::count_if(primitives.begin(), primitives.end(),
                        [&](const IndexedPrimitiveRecord& p) { return p.light == row; }) == 2);
    double area = std::pow(flat.frame.scale, 2); // 1 x 1
    CHECK((quad->area == Approx(area) && quad->extra == Approx(1 / area)));
    CHECK(flat.features.has(feature_emitter_area_parallelogram));
    CHECK(flat.features.has(feature_emitter_area_triangle));
}

TEST_CASE("Parallelograms: an emitting mesh keeps what does not pair up") {
    Mesh mesh = numerics::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.positions.push_back({0.5, 2, 0});
    mesh.triangles.push_back({3, 2, 4});
    CHECK((starts_parallelogram(mesh, {}) == std::vector{true, false, false}));
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    CHECK(starts_parallelogram(mesh, {})[0]);
    for (glm::dvec3& n : mesh.normals)
        n = -n; // the light shines the other way, from both
    CHECK(starts_parallelogram(mesh, {})[0]);
    mesh.normals[1] = {0, 0, 9}; // only the first triangle's normals still agree with its winding
    CHECK_FALSE(starts_parallelogram(mesh, {})[0]);
}
