// Rays a second beside Embree's, and where the answers differ.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace parhelion::bench {

struct TraversalOptions {
    bool quick = false;          ///< fewer rays and repeats; the same scenes
    bool processor_time = false; ///< in place of the wall clock: for machines that others use too
    int threads = 1;             ///< Embree's; the OpenCL device has those it was started with
};

/// {threads, scenes: [{name, triangles, sets: [{name, rays, tracers, ratios, mismatches}]}]}.
nlohmann::json measure_traversal(const TraversalOptions& options);

} // namespace parhelion::bench
