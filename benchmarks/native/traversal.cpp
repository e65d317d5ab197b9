// Rays a second beside Embree's, and where the answers differ.
#include "benchmarks/native/traversal.h"

#include "benchmarks/native/embree_rays.h"
#include "benchmarks/native/mismatch.h"
#include "benchmarks/native/opencl_rays.h"
#include "benchmarks/native/ray_sets.h"
#include "benchmarks/native/statistics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <numeric>

namespace parhelion::bench {
namespace {

struct Timed {
    Tracer* tracer;
    bool ours, robust;
    std::vector<double> seconds{}; ///< one a repeat
};

/// Ours first, then every way into both Embree scenes; each repeat runs them in turn.
std::vector<Timed> time_all(const RaySet& set, std::vector<Timed> tracers, int repeats,
                            bool processor_time) {
    for (Timed& t : tracers) // pages and caches; the kernels' first launch
        trace_all(
            *t.tracer,
            std::span(set.rays).first(std::min<std::size_t>(set.rays.size(), Tracer::wave_rays)),
            set.depth, set.any_hit);
    for (int repeat = 0; repeat < repeats; repeat++)
        for (Timed& t : tracers)
            t.seconds.push_back(
                trace_all(*t.tracer, set.rays, set.depth, set.any_hit, nullptr, processor_time));
    return tracers;
}

/// The fastest Embree way of one mode, and ours beside it: the middle of the repeats' ratios.
nlohmann::json beside_best(const std::vector<Timed>& timed, bool robust) {
    const Timed *best = nullptr, *ours = nullptr;
    for (const Timed& t : timed) {
        if (t.ours)
            ours = &t;
        else if (t.robust == robust && (!best || median(t.seconds) < median(best->seconds)))
            best = &t;
    }
    return {{"best", best->tracer->name()}, {"ratio", median_ratio(best->seconds, ours->seconds)}};
}

nlohmann::json to_json(const Mismatches& m) {
    return {{"differ", m.differ},
            {"ties", m.ties},
            {"ours_wrong", m.ours_wrong},
            {"theirs_wrong", m.theirs_wrong}};
}

struct World {
    TriangleScene scene;
    std::vector<PrimitiveRecord> primitives;
    Bvh bvh;
    BvhStatistics statistics;
    int root;
    EmbreeScene usual, robust;

    World(TriangleScene s, int threads)
        : scene(std::move(s)), primitives(primitive_records(scene.mesh)),
          root(bvh_append(bvh, indexed_geometry(scene.mesh), &statistics)),
          usual(scene.mesh, false, threads), robust(scene.mesh, true, threads) {}
};

nlohmann::json measure_set(const RaySet& set, const World& world, OpenClTracer& ours,
                           const TraversalOptions& options, int repeats) {
    auto usual = embree_tracers(world.usual, options.threads, set.coherent);
    auto robust = embree_tracers(world.robust, options.threads, set.coherent);
    std::vector<Hit> our_hits, reference_hits;
    trace_all(ours, set.rays, set.depth, set.any_hit, &our_hits);
    trace_all(*robust.front(), set.rays, set.depth, set.any_hit, &reference_hits);
    Mismatches mismatches =
        count_mismatches(world.primitives, set.rays, our_hits, reference_hits, set.any_hit);

    std::vector<Timed> tracers{{&ours, true, true}};
    for (const auto& t : usual)
        tracers.push_back({t.get(), false, false});
    for (const auto& t : robust)
        tracers.push_back({t.get(), false, true});
    tracers = time_all(set, std::move(tracers), repeats, options.processor_time);

    auto hits = static_cast<double>(std::count_if(our_hits.begin(), our_hits.end(),
                                                  [](const Hit& h) { return h.primitive >= 0; }));
    auto rays = static_cast<double>(set.rays.size());
    nlohmann::json rows = nlohmann::json::array();
    for (const Timed& t : tracers)
        rows.push_back({{"name", t.tracer->name()},
                        {"robust", t.robust},
                        {"mrays_per_second", 1e-6 * rays / median(t.seconds)},
                        {"seconds", t.seconds}});
    nlohmann::json result = {{"name", set.name},
                             {"rays", set.rays.size()},
                             {"hit_share", hits / rays},
                             {"tracers", rows},
                             {"default", beside_best(tracers, false)},
                             {"robust", beside_best(tracers, true)},
                             {"mismatches", to_json(mismatches)}};
    fmt::print(stderr, "  {:22} {:7.2f} Mrays/s, {:.2f} x {}, {:.2f} x {}; {} differ, {} no ties\n",
               set.name, 1e-6 * rays / median(tracers.front().seconds),
               result["default"]["ratio"].get<double>(),
               result["default"]["best"].get<std::string>(),
               result["robust"]["ratio"].get<double>(), result["robust"]["best"].get<std::string>(),
               mismatches.differ, mismatches.differ - mismatches.ties);
    return result;
}

nlohmann::json measure_scene(TriangleScene scene, int resolution, int repeats,
                             const TraversalOptions& options) {
    int threads = options.threads;
    World world(std::move(scene), threads);
    auto count = static_cast<double>(world.primitives.size());
    fmt::print(stderr, "{}: {} triangles, {} thread(s); trees in {:.2f} s, Embree's in {:.2f} s\n",
               world.scene.name, world.primitives.size(), threads, world.statistics.build_seconds,
               world.usual.commit_seconds());
    RenderDevice device(choose_device(""));
    OpenClTracer ours(device, world.bvh, world.root, world.primitives.size());
    auto reference = embree_tracers(world.robust, threads, false);
    auto sets = make_ray_sets(world.scene, world.primitives, resolution, *reference.front());
    nlohmann::json rows = nlohmann::json::array();
    for (const RaySet& set : sets)
        rows.push_back(measure_set(set, world, ours, options, repeats));
    return {{"name", world.scene.name},
            {"triangles", world.primitives.size()},
            {"bytes_per_triangle", static_cast<double>(world.statistics.bytes) / count},
            {"embree_bytes_per_triangle", static_cast<double>(world.usual.bytes()) / count},
            {"device", device.device.name},
            {"lanes", device.device.tracing_lanes()},
            {"sets", rows}};
}

} // namespace

nlohmann::json measure_traversal(const TraversalOptions& options) {
    constexpr std::size_t large = 3'200'000;
    nlohmann::json scenes = nlohmann::json::array();
    if (options.quick) {
        scenes.push_back(measure_scene(bunny_room(), 256, 3, options));
        scenes.push_back(measure_scene(landscape(large), 256, 3, options));
    } else {
        scenes.push_back(measure_scene(bunny_room(), 512, 7, options));
        scenes.push_back(measure_scene(landscape(large), 1024, 3, options));
    }
    return {{"threads", options.threads},
            {"clock", options.processor_time ? "processor" : "wall"},
            {"scenes", scenes}};
}

} // namespace parhelion::bench
