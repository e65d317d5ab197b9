// Rays inside closed meshes of long, thin and huge triangles, up to 1e8 times as long as wide, at
// their corners and edges and anywhere: none gets out, through 1, 8 and 16 lanes alike.
#include "host/catalogue/lane_traversals.h"
#include "host/numerics/long_meshes.h"

namespace parhelion::stress {
namespace {

/// To a corner, to a point of an edge, to another point inside or anywhere.
TracedRay ray_inside(const rays::LongMesh& m, rays::Random& random, std::uint64_t i) {
    const PrimitiveRecord& p = m.mesh[random() % m.mesh.size()];
    rays::Vector a{p.ax, p.ay, p.az}, b{p.bx, p.by, p.bz}, o = m.inside(random);
    float s = rays::uniform(random, 0, 1);
    rays::Vector direction =
        i % 4 == 0   ? rays::subtract(a, o)
        : i % 4 == 1 ? rays::subtract(rays::add(a, rays::scaled(rays::subtract(b, a), s)), o)
        : i % 4 == 2 ? rays::subtract(m.inside(random), o)
                     : rays::uniform_vector(random, -1, 1);
    return {o, direction};
}

struct Case {
    std::string name;
    double half; ///< of the length; the other way it is about 1
    rays::Placing placing;
};

/// Turned or away from the origin, corners are rounded to what their coordinates can say.
std::vector<Case> cases(rays::Random& random) {
    std::vector<Case> list;
    for (double half : {1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8})
        list.push_back({fmt::format("{:g} long", half), half, {}});
    for (double half : {1e1, 1e2, 1e3, 1e4})
        list.push_back({fmt::format("{:g} long, turned", half), half, rays::turned(random, {})});
    for (double half : {1e1, 1e2, 1e3})
        list.push_back({fmt::format("{:g} long, turned, away", half), half,
                        rays::turned(random, {3e3, -7e3, 5e3})});
    return list;
}

struct Counts {
    std::uint64_t rays = 0, leaks = 0, light_leaks = 0;
};

void count_leaks(LaneTraversals& traversals, const rays::LongMesh& m, std::uint64_t count,
                 rays::Random& random, Counts& counts) {
    traversals.upload(m.mesh);
    Bundles bundles([&](std::uint64_t i) { return ray_inside(m, random, i); });
    in_batches(
        count, [&](std::uint64_t i) { return bundles.ray(random, i); },
        [&](const std::vector<TracedRay>& list) {
            std::vector<TracedHit> hits = traversals.closest(list);
            std::vector<bool> occluded = traversals.occluded(list);
            for (std::size_t i = 0; i < list.size(); i++) {
                counts.leaks += hits[i].primitive < 0;
                counts.light_leaks += !occluded[i];
            }
            counts.rays += list.size();
        });
}

} // namespace

Checks row_long_triangles(StressRun& run) {
    Checks checks;
    rays::Random random(static_cast<unsigned>(run.seed));
    std::vector<Case> list = cases(random);
    LaneTraversals traversals(run);
    // Of lanes other than the device's own a share is traced: all the same where rays are few.
    std::uint64_t count = run.count(25'000, 300'000, 1'000'000'000) / (list.size() * 7);
    for (std::size_t i = 0; i < list.size(); i++) {
        Counts c;
        for (const rays::LongMesh& m : rays::long_meshes(list[i].half, list[i].placing))
            count_leaks(traversals, m, count, random, c);
        auto name = [&](const char* what) {
            return fmt::format("long triangles, {}: {}", list[i].name, what);
        };
        checks.push_back(rays_check(name("paths that leak"), c.leaks, c.rays));
        checks.push_back(rays_check(name("shadow rays that leak"), c.light_leaks, c.rays));
        run.done(static_cast<double>(i + 1) / static_cast<double>(list.size()));
    }
    for (const Check& check : traversals.checks("long triangles"))
        checks.push_back(check);
    return checks;
}

} // namespace parhelion::stress
