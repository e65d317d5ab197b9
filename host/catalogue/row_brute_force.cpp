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

std::vector<Tried> all_tried() {
    return {{"one triangle", {rays::triangle({-1, -1, 0}, {1, -1, .1f}, {0, 1, .2f})}},
            {"closed mesh", rays::subdivided_sphere(3, 1, {0, 0, 0})},
            {"small triangles", rays::random_triangles(2000, .1f)},
            {"large triangles", rays::random_triangles(500, 1.f)},
            {"triangles, spheres, disks", rays::random_mixture(900)},
            {"grid", rays::grid(20, .25f)},
            {"needles", rays::needles(1000)},
            {"repeated triangles", rays::repeated(rays::random_triangles(50, .5f), 40)},
            {"each within the last", rays::geometric_series(4, 60)},
            {"one plane", sheet(300), ray_at_sheet}};
}

/// Every other sixteen rays go nearly the way of the first of them.
class RayMaker {
public:
    RayMaker(const Tried& tried, rays::Random& random) : tried_(tried), random_(random) {}

    TracedRay operator()(std::uint64_t i) {
        auto at = static_cast<int>(i % 16);
        if (i / 16 % 2 == 0 || at == 0) first_ = tried_.ray(random_, static_cast<int>(i));
        rays::Ray ray = first_;
        if (i / 16 % 2 == 1) {
            for (float& d : ray.direction)
                d *= 1.f + .01f * static_cast<float>(at);
            ray.direction[i % 3] *= 1.02f;
        }
        return {ray.origin, ray.direction};
    }

private:
    const Tried& tried_;
    rays::Random& random_;
    rays::Ray first_{};
};

struct Differences {
    std::uint64_t hits = 0, other = 0, other_shadows = 0;
};

Differences differences(Traversal& traversal, const Tried& tried, std::uint64_t count,
                        std::uint64_t seed) {
    rays::Random random(static_cast<unsigned>(seed));
    Differences found;
    in_batches(count, RayMaker(tried, random), [&](const std::vector<TracedRay>& list) {
        std::vector<TracedHit> hits = traversal.closest(list);
        std::vector<bool> occluded = traversal.occluded(list);
        for (std::size_t i = 0; i < list.size(); i++) {
            rays::Hit truth = rays::brute_force(tried.mesh, {list[i].origin, list[i].direction});
            found.hits += truth.primitive >= 0;
            found.other += hits[i].primitive != truth.primitive || hits[i].t != truth.t;
            found.other_shadows += occluded[i] != (truth.primitive >= 0);
        }
    });
    return found;
}

} // namespace

Checks row_brute_force(StressRun& run) {
    Checks checks;
    std::vector<Tried> scenes = all_tried();
    for (const Tried& tried : scenes) {
        std::string name = fmt::format("tree against every primitive, {}", tried.name);
        run.traversal().upload(tried.mesh);
        std::uint64_t count = run.count(12'000, 100'000, 4'000'000);
        Differences found = differences(run.traversal(), tried, count, run.seed);
        checks.push_back(rays_check(name + ": other hits", found.other, count));
        checks.push_back(rays_check(name + ": other shadows", found.other_shadows, count));
        checks.push_back({.name = name + ": rays that hit",
                          .value = static_cast<double>(found.hits) / static_cast<double>(count),
                          .target = 0.01, // or it would have tested nothing
                          .at_least = true,
                          .unit = "share",
                          .samples = count});
        run.done(static_cast<double>(checks.size()) / static_cast<double>(3 * scenes.size()));
    }
    checks.push_back(host_check("tree against every primitive", run.traversal()));
    return checks;
}

} // namespace parhelion::stress
