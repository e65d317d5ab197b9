// Building trees beside Embree's, from thousands to millions of triangles.
#include "benchmarks/native/build.h"

#include "benchmarks/native/embree_scene.h"
#include "benchmarks/native/statistics.h"
#include "host/bvh/bvh.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <oneapi/tbb/global_control.h>

namespace parhelion::bench {
namespace {

struct Built {
    BvhStatistics ours;
    double embree_seconds, robust_seconds;
    std::size_t embree_bytes;
};

Built build_once(const TriangleMesh& mesh, const IndexedGeometry& geometry, int threads) {
    Built b{};
    {
        Bvh bvh;
        bvh_append(bvh, geometry, &b.ours);
    }
    {
        EmbreeScene usual(mesh, false, threads);
        b.embree_seconds = usual.commit_seconds();
        b.embree_bytes = usual.bytes();
    }
    b.robust_seconds = EmbreeScene(mesh, true, threads).commit_seconds();
    return b;
}

nlohmann::json measure_size(std::size_t triangles, int threads, int repeats) {
    TriangleMesh mesh = hills_and_rocks(triangles);
    IndexedGeometry geometry = indexed_geometry(mesh);
    std::size_t triangles_made = geometry.primitives.size();
    auto count = static_cast<double>(triangles_made);
    std::vector<double> ours, embree, robust;
    Built built = build_once(mesh, geometry, threads); // warms up threads and memory
    for (int i = 0; i < repeats; i++) {
        built = build_once(mesh, geometry, threads);
        ours.push_back(built.ours.build_seconds);
        embree.push_back(built.embree_seconds);
        robust.push_back(built.robust_seconds);
    }
    fmt::print(stderr, "  {:9} triangles: {:.3f} s, {:.2f} of Embree's time\n", triangles_made,
               median(ours), median_ratio(ours, embree));
    return {{"triangles", triangles_made},
            {"seconds", median(ours)},
            {"embree_seconds", median(embree)},
            {"embree_robust_seconds", median(robust)},
            {"ratio", median_ratio(ours, embree)},
            {"robust_ratio", median_ratio(ours, robust)},
            {"triangles_per_second", count / median(ours)},
            {"embree_triangles_per_second", count / median(embree)},
            {"sah_cost", built.ours.sah_cost},
            {"depth", built.ours.depth},
            {"leaf_fill", built.ours.leaf_fill},
            {"bytes_per_triangle", static_cast<double>(built.ours.bytes) / count},
            {"embree_bytes_per_triangle", static_cast<double>(built.embree_bytes) / count}};
}

} // namespace

nlohmann::json measure_build(const BuildOptions& options) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                              static_cast<std::size_t>(options.threads));
    fmt::print(stderr, "build: {} thread(s)\n", options.threads);
    struct Size {
        std::size_t triangles;
        int repeats;
    };
    std::vector<Size> sizes{{10'000, 21}, {30'000, 15}, {100'000, 9}, {300'000, 7}, {1'000'000, 5}};
    if (!options.quick) {
        sizes.push_back({3'000'000, 3});
        sizes.push_back({10'000'000, 3});
    }
    nlohmann::json rows = nlohmann::json::array();
    for (const Size& s : sizes)
        rows.push_back(measure_size(s.triangles, options.threads, s.repeats));
    return {{"threads", options.threads}, {"sizes", rows}};
}

} // namespace parhelion::bench
