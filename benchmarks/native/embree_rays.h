// Embree as a tracer, through each of its ways to hand over rays.
#pragma once

#include "benchmarks/native/embree_scene.h"
#include "benchmarks/native/tracer.h"

#include <memory>
#include <vector>

namespace parhelion::bench {

/// rtcIntersect1, 4, 8, 16 and 1M with their any-hit twins, each with and without the hint that
/// rays are coherent. `scene` must outlive them. Rays lie in the layout of the call before the
/// clock starts, and hits stay in it.
std::vector<std::unique_ptr<Tracer>> embree_tracers(const EmbreeScene& scene, int threads,
                                                    bool with_coherent);

} // namespace parhelion::bench
