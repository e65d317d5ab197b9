// The five sets of rays of a small path tracer: camera rays, two bounces, and the shadow rays of
// the first two vertices.
#pragma once

#include "benchmarks/native/tracer.h"
#include "benchmarks/native/triangle_scene.h"

#include <span>
#include <string>
#include <vector>

namespace parhelion::bench {

struct RaySet {
    std::string name;
    int depth;     ///< bounces before it, as the stage kernels are told
    bool any_hit;  ///< shadow rays
    bool coherent; ///< told to Embree as a hint
    std::vector<Ray> rays;
};

/// `resolution` squared camera rays in blocks of 4x4 pixels, row after row of blocks, as the
/// renderer has them; the others follow from the closest hits that `reference` finds, in that order
/// and without the rays that miss. Directions are cosine-weighted, light points uniform; rays leave
/// surfaces as the renderer's do.
std::vector<RaySet> make_ray_sets(const TriangleScene& scene,
                                  std::span<const PrimitiveRecord> primitives, int resolution,
                                  Tracer& reference);

} // namespace parhelion::bench
