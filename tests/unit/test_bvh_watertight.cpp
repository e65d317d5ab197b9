// Rays from inside a closed mesh, aimed at its edges and corners, never get out.
#include "host/numerics/shapes.h"

#include <catch2/catch.hpp>

using namespace parhelion;
using namespace parhelion::rays;

namespace {

/// Corners, and points of the edges as exactly as floats can say.
std::vector<Vector> targets(const Primitives& mesh) {
    Random random(5);
    std::vector<Vector> result;
    for (const PrimitiveRecord& p : mesh) {
        Vector corners[3] = {{p.ax, p.ay, p.az}, {p.bx, p.by, p.bz}, {p.cx, p.cy, p.cz}};
        for (int i = 0; i < 3; i++) {
            const Vector &a = corners[i], &b = corners[(i + 1) % 3];
            result.push_back(a);
            for (float s : {.5f, uniform(random, 0, 1)})
                result.push_back(add(a, scaled(subtract(b, a), s)));
        }
    }
    return result;
}

struct Leaks {
    int rays = 0, mesh = 0, tree = 0;
};

Leaks count_leaks(const Primitives& mesh, float radius, const Vector& centre) {
    Bvh bvh;
    int root = bvh_append(bvh, indexed_geometry(mesh));
    Random random(6);
    Leaks leaks;
    std::vector<Vector> aims = targets(mesh);
    for (int round = 0; round < 8; round++) {
        Vector origin =
            round == 0 ? centre : add(centre, uniform_vector(random, -.4f * radius, .4f * radius));
        for (const Vector& aim : aims) {
            Ray ray{origin, subtract(aim, origin)};
            leaks.rays++;
            if (walk(bvh, root, ray).primitive >= 0) continue;
            leaks.tree++;
            leaks.mesh += brute_force(mesh, ray).primitive < 0;
        }
    }
    return leaks;
}

} // namespace

TEST_CASE("No ray leaks out of a closed mesh through an edge or a corner", "[bvh]") {
    const Vector offsets[] = {{0, 0, 0}, {.1f, 3.f, -70.f}, {1000, 1000, 1000}};
    int rays = 0;
    for (const Vector& offset : offsets)
        for (float radius : {1e-2f, 1.f, 300.f}) {
            CAPTURE(radius, offset[0]);
            if (offset[0] > 1e4f * radius)
                continue; // the mesh would be less than a few units in the last place wide
            for (const Primitives& mesh :
                 {subdivided_sphere(3, radius, offset), cube_surface(12, radius, offset)}) {
                CAPTURE(mesh.size());
                Leaks leaks = count_leaks(mesh, radius, offset);
                rays += leaks.rays;
                CHECK(leaks.mesh == 0); // the triangle test's fault
                CHECK(leaks.tree == 0); // or that of the boxes
            }
        }
    CHECK(rays > 500000);
}
