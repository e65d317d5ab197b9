// The tree on the device against every primitive on the host.
#include "host/catalogue/ray_rows.h"

#include <cmath>

namespace parhelion::stress {
namespace {

/// In one plane across x: boxes without thickness, which rays from near by and along the plane meet
/// later than they hit some of the triangles, by what rounding does to large ones.
rays::Primitives sheet(int count) {
    rays::Primitives triangles = rays::random_triangles(count, 1);
    for (PrimitiveRecord& p : triangles)
        p.ax = p.bx = p.cx = 0;
    return triangles;
}

rays::Ray ray_at_sheet(rays::Random& random, int) {
    float height = std::pow(10.f, rays::uniform(random, -5, -2));
    rays::Vector origin = rays::uniform_vector(random, -1, 1),
                 way = rays::scaled(rays::uniform_vector(random, -10, 10), height);
    origin[0] = height, way[0] = -height;
    return {origin, way};
}

struct Tried {
    const char* name;
    rays::Primitives mesh;
    rays::Ray (*ray)(rays::Random& random, int number) = rays::random_ray;
};

} // namespace

Checks row_brute_force(StressRun& run) {
    Traversal& traversal = run.traversal();
    const Tried scenes[] = {
        {"closed mesh", rays::subdivided_sphere(3, 1, {0, 0, 0})},
        {"triangles, spheres, disks", rays::random_mixture(600)},
        {"needles", rays::needles(500)},
        {"repeated triangles", rays::repeated(rays::random_triangles(100, .2f), 4)},
        {"each within the last", rays::geometric_series(4, 60)},
        {"one plane", sheet(300), ray_at_sheet}};
    Checks checks;
    for (const auto& [name, mesh, make_ray] : scenes) {
        traversal.upload(mesh);
        rays::Random random(static_cast<unsigned>(run.seed));
        std::uint64_t count = run.count(5'000, 100'000, 4'000'000), other = 0, other_any = 0;
        auto ray = [&, make_ray = make_ray](std::uint64_t i) {
            rays::Ray r = make_ray(random, static_cast<int>(i));
            return TracedRay{r.origin, r.direction};
        };
        in_batches(count, ray, [&, &mesh = mesh](const std::vector<TracedRay>& list) {
            std::vector<TracedHit> hits = traversal.closest(list);
            std::vector<bool> occluded = traversal.occluded(list);
            for (std::size_t i = 0; i < list.size(); i++) {
                rays::Hit truth = rays::brute_force(mesh, {list[i].origin, list[i].direction});
                other += hits[i].primitive != truth.primitive ||
                         (truth.primitive >= 0 && hits[i].t != truth.t);
                other_any += occluded[i] != (truth.primitive >= 0);
            }
        });
        checks.push_back(rays_check(
            fmt::format("tree against every primitive, {}: other hits", name), other, count));
        checks.push_back(
            rays_check(fmt::format("tree against every primitive, {}: other shadows", name),
                       other_any, count));
    }
    checks.push_back(host_check("tree against every primitive", traversal));
    return checks;
}

} // namespace parhelion::stress
