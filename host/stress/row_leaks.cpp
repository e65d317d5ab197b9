// Rays aimed at the edges and corners of closed meshes, from inside: at the origin, far from it,
// large and small.
#include "host/stress/rows.h"
#include "host/stress/traversal.h"

#include "host/stress/shapes.h"

namespace parhelion::stress {
namespace {

using rays::Vector;

struct Place {
    std::string name;
    float radius;
    Vector centre;
};

/// Far from the origin a mesh is as large as its coordinates' digits allow.
std::vector<Place> places() {
    std::vector<Place> list{{"at the origin", 1, {0, 0, 0}},
                            {"at (148376, 1234, -223423)", 64, {148376, 1234, -223423}},
                            {"at 1e6", 4096, {1e6f, -1e6f, 1e6f}},
                            {"scale 4096", 4096, {0, 0, 0}}};
    for (float scale : {1e-6f, 1e-4f, 1e-2f, 1e2f, 1e4f, 1e6f})
        list.push_back({fmt::format("scale {:g}", scale), scale, {0, 0, 0}});
    return list;
}

std::vector<std::pair<std::string, rays::Primitives>> meshes(const Place& place) {
    return {{"sphere", rays::subdivided_sphere(4, place.radius, place.centre)},
            {"cube", rays::cube_surface(12, place.radius, place.centre)}};
}

/// To a corner, to the middle of an edge, or to a point of one that is as exactly on it as floats
/// can say; the first rays start in the middle.
TracedRay aimed_ray(const rays::Primitives& mesh, const Place& place, rays::Random& random,
                    std::size_t i) {
    const PrimitiveRecord& p = mesh[i % mesh.size()];
    Vector a{p.ax, p.ay, p.az}, b{p.bx, p.by, p.bz};
    float s = i % 3 == 0 ? 0.f : i % 3 == 1 ? .5f : rays::uniform(random, 0, 1);
    Vector aim = rays::add(a, rays::scaled(rays::subtract(b, a), s)), o = place.centre;
    if (i >= mesh.size())
        o = rays::add(o, rays::uniform_vector(random, -.4f * place.radius, .4f * place.radius));
    Vector v = rays::subtract(aim, o);
    return {{o[0], o[1], o[2]}, {v[0], v[1], v[2]}};
}

struct Counts {
    std::uint64_t device_rays = 0, host_rays = 0, leaks = 0, light_leaks = 0, host_leaks = 0;
};

/// Traces `count` rays on the device in batches, and the first of each batch through the host's
/// walk as well.
void count_leaks(Traversal& traversal, const rays::Primitives& mesh, const Place& place,
                 std::uint64_t count, std::uint64_t seed, Counts& counts) {
    constexpr std::uint64_t batch = 1 << 17;
    Bvh bvh;
    int root = bvh_append(bvh, mesh);
    traversal.upload(bvh, root);
    rays::Random random(static_cast<unsigned>(seed));
    std::vector<TracedRay> list;
    for (std::uint64_t first = 0; first < count; first += batch) {
        list.clear();
        for (std::uint64_t i = first; i < std::min(count, first + batch); i++)
            list.push_back(aimed_ray(mesh, place, random, i));
        std::vector<TracedHit> hits = traversal.closest(list);
        std::vector<bool> occluded = traversal.occluded(list);
        for (std::size_t i = 0; i < list.size(); i++) {
            counts.leaks += hits[i].primitive < 0;
            counts.light_leaks += !occluded[i];
            if (i >= list.size() / 64) continue;
            const TracedRay& r = list[i];
            counts.host_leaks += rays::walk(bvh, root,
                                            {{r.origin[0], r.origin[1], r.origin[2]},
                                             {r.direction[0], r.direction[1], r.direction[2]}})
                                     .primitive < 0;
            counts.host_rays++;
        }
        counts.device_rays += list.size();
    }
}

} // namespace

Checks row_leaks(StressRun& run) {
    Checks checks;
    Traversal traversal(run.device, {.lanes = run.device.device.lanes()});
    std::vector<Place> list = places();
    std::uint64_t count = run.count(100'000, 10'000'000, 1'000'000'000) / (2 * list.size());
    for (std::size_t i = 0; i < list.size(); i++) {
        Counts counts;
        for (const auto& [name, mesh] : meshes(list[i]))
            count_leaks(traversal, mesh, list[i], count, run.seed + 17 * i, counts);
        auto check = [&](const char* what, std::uint64_t leaks, std::uint64_t tried) {
            checks.push_back({.name = fmt::format("leaks, {}: {}", list[i].name, what),
                              .value = static_cast<double>(leaks),
                              .target = 0,
                              .unit = "rays",
                              .samples = tried});
        };
        check("paths", counts.leaks, counts.device_rays);
        check("shadow rays", counts.light_leaks, counts.device_rays);
        check("host's walk", counts.host_leaks, counts.host_rays);
        run.done(static_cast<double>(i + 1) / static_cast<double>(list.size()));
    }
    return checks;
}

} // namespace parhelion::stress
