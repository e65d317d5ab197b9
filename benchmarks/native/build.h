// Building trees beside Embree's, from thousands to millions of triangles.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace parhelion::bench {

struct BuildOptions {
    bool quick = false; ///< to 1 M triangles
    int threads = 1;
};

/// {threads, sizes: [{triangles, seconds, embree_seconds, ratio, sah_cost, bytes_per_triangle,
/// ...}]}.
nlohmann::json measure_build(const BuildOptions& options);

} // namespace parhelion::bench
