// Walking the BVH finds what testing every primitive finds.
#include "host/numerics/shapes.h"

#include <catch2/catch.hpp>

using namespace parhelion;
using namespace parhelion::rays;

namespace {

struct Outcome {
    int rays = 0, hits = 0, differ = 0;
};

Outcome compare(const Primitives& primitives, int rays) {
    Bvh bvh;
    int root = bvh_append(bvh, indexed_geometry(primitives));
    Random random(4);
    Outcome outcome;
    for (int i = 0; i < rays; i++) {
        Ray ray = random_ray(random, i);
        Hit expected = brute_force(primitives, ray), found = walk(bvh, root, ray);
        outcome.rays++;
        outcome.hits += expected.primitive >= 0;
        outcome.differ += !(found == expected);
    }
    return outcome;
}

} // namespace

TEST_CASE("A walk finds the same primitive at the same distance as brute force", "[bvh]") {
    struct Case {
        const char* name;
        Primitives primitives;
        int rays;
    };
    const Case cases[] = {
        {"small random triangles", random_triangles(1000, .1f), 10000},
        {"large random triangles", random_triangles(200, 1.f), 10000},
        {"one triangle", random_triangles(1, 2.f), 10000},
        {"triangles, spheres and disks", random_mixture(900), 10000},
        {"a sphere of triangles", subdivided_sphere(3, .9f, {.1f, 0, -.1f}), 10000},
        {"needles", needles(500), 5000},
        {"a flat grid", grid(20, .25f), 5000},
        {"duplicates", repeated(random_triangles(60, .5f), 10), 5000},
        {"a flat grid, three times", repeated(grid(10, 0.f), 3), 5000},
        {"a geometric series", geometric_series(2, 300), 5000},
    };
    for (const Case& c : cases) {
        CAPTURE(c.name);
        Outcome outcome = compare(c.primitives, c.rays);
        CHECK(outcome.hits > c.rays / 200);
        CHECK(outcome.differ == 0);
    }
}
