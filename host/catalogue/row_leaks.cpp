// Rays aimed at the edges and corners of closed meshes, from inside: at the origin, far from it,
// large and small.
#include "host/catalogue/ray_rows.h"

namespace parhelion::stress {
namespace {

struct NamedPlace {
    std::string name;
    Place place;
};

/// Far from the origin a mesh is as large as its coordinates' digits allow.
std::vector<NamedPlace> places() {
    std::vector<NamedPlace> list{{"at the origin", {1, {0, 0, 0}}},
                                 {"at (148376, 1234, -223423)", {64, {148376, 1234, -223423}}},
                                 {"at 1e6", {4096, {1e6f, -1e6f, 1e6f}}},
                                 {"scale 4096", {4096, {0, 0, 0}}}};
    for (float scale : {1e-6f, 1e-4f, 1e-2f, 1e2f, 1e4f, 1e6f})
        list.push_back({fmt::format("scale {:g}", scale), {scale, {0, 0, 0}}});
    return list;
}

std::vector<rays::Primitives> meshes(const Place& place) {
    return {rays::subdivided_sphere(4, place.radius, place.centre),
            rays::cube_surface(12, place.radius, place.centre)};
}

struct Counts {
    std::uint64_t rays = 0, leaks = 0, light_leaks = 0;
};

void count_leaks(Traversal& traversal, const rays::Primitives& mesh, const Place& place,
                 std::uint64_t count, std::uint64_t seed, Counts& counts) {
    traversal.upload(mesh);
    rays::Random random(static_cast<unsigned>(seed));
    in_batches(
        count, [&](std::uint64_t i) { return aimed_ray(mesh, place, random, i); },
        [&](const std::vector<TracedRay>& list) {
            std::vector<TracedHit> hits = traversal.closest(list);
            std::vector<bool> occluded = traversal.occluded(list);
            for (std::size_t i = 0; i < list.size(); i++) {
                counts.leaks += hits[i].primitive < 0;
                counts.light_leaks += !occluded[i];
            }
            counts.rays += list.size();
        });
}

} // namespace

Checks row_leaks(StressRun& run) {
    Checks checks;
    std::vector<NamedPlace> list = places();
    std::uint64_t count = run.count(300'000, 10'000'000, 1'000'000'000) / (2 * list.size());
    for (std::size_t i = 0; i < list.size(); i++) {
        Counts counts;
        for (const rays::Primitives& mesh : meshes(list[i].place))
            count_leaks(run.traversal(), mesh, list[i].place, count, run.seed + 17 * i, counts);
        auto check = [&](const char* what, std::uint64_t leaks, std::uint64_t tried) {
            checks.push_back(
                rays_check(fmt::format("leaks, {}: {}", list[i].name, what), leaks, tried));
        };
        check("paths", counts.leaks, counts.rays);
        check("shadow rays", counts.light_leaks, counts.rays);
        run.done(static_cast<double>(i + 1) / static_cast<double>(list.size()));
    }
    checks.push_back(host_check("leaks", run.traversal()));
    return checks;
}

} // namespace parhelion::stress
