// No ray from inside a closed mesh gets out on the device, wherever the mesh is and however large.
#include "tests/support/traversal.h"

#include "host/catalogue/ray_rows.h"

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

std::vector<TestRay> aimed_rays(const rays::Primitives& mesh, const Place& place,
                                std::size_t count) {
    rays::Random random(11);
    std::vector<TestRay> rays;
    rays.reserve(count);
    for (std::size_t i = 0; i < count; i++)
        rays.push_back(aimed_ray(mesh, place, random, i));
    return rays;
}

} // namespace

TEST_CASE("A million rays at edges and corners of closed meshes: no leak on the device",
          "[device]") {
    TestDevice d;
    const Place places[] = {{1, {0, 0, 0}}, {64, {148376, 1234, -223423}}, {4096, {0, 0, 0}}};
    std::size_t rays_in_all = 0;
    for (const Variant& variant : variants) {
        parhelion::test::Traversal traversal(d, variant);
        // The default variant has the full number of rays, the others check that they are no worse.
        std::size_t count = variant.lanes == 16 && !variant.portable ? 340000 : 30000;
        for (const Place& place : places) {
            rays::Primitives mesh = rays::subdivided_sphere(4, place.radius, place.centre);
            traversal.upload(mesh);
            std::vector<TestRay> rays = aimed_rays(mesh, place, count);
            std::vector<TestHit> hits = traversal.closest(rays);
            std::vector<bool> occluded = traversal.occluded(rays);
            std::size_t leaks = 0, light_leaks = 0;
            for (std::size_t i = 0; i < rays.size(); i++) {
                leaks += hits[i].primitive < 0;
                light_leaks += !occluded[i];
            }
            CAPTURE(variant.name(), place.radius, place.centre[0]);
            CHECK(leaks == 0);
            CHECK(light_leaks == 0);
            rays_in_all += rays.size();
        }
    }
    CHECK(rays_in_all >= 1000000);
}
