// The tree on the device against every primitive on the host.
#include "host/stress/ray_rows.h"

namespace parhelion::stress {

Checks row_brute_force(StressRun& run) {
    Traversal& traversal = run.traversal();
    const std::pair<const char*, rays::Primitives> scenes[] = {
        {"closed mesh", rays::subdivided_sphere(3, 1, {0, 0, 0})},
        {"triangles, spheres, disks", rays::random_mixture(600)},
        {"needles", rays::needles(500)},
        {"repeated triangles", rays::repeated(rays::random_triangles(100, .2f), 4)},
        {"each within the last", rays::geometric_series(4, 60)}};
    Checks checks;
    for (const auto& [name, mesh] : scenes) {
        traversal.upload(mesh);
        rays::Random random(static_cast<unsigned>(run.seed));
        std::uint64_t count = run.count(5'000, 100'000, 4'000'000), other = 0, other_any = 0;
        auto ray = [&](std::uint64_t i) {
            rays::Ray r = rays::random_ray(random, static_cast<int>(i));
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
