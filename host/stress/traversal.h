// Many rays at once through the kernels `intersect` and `shadow`, on path and shadow states filled
// by hand.
#pragma once

#include "host/bvh/bvh.h"
#include "host/cl/buffer.h"
#include "host/render/render_device.h"

#include <array>
#include <limits>
#include <span>
#include <vector>

namespace parhelion::stress {

struct TracedRay {
    std::array<float, 3> origin, direction;
    float t_max = std::numeric_limits<float>::infinity();
    int excluded = -1;
};

struct TracedHit {
    float t, b1, b2;
    int primitive; ///< -1: nothing

    bool operator==(const TracedHit&) const = default;
};

/// A tree on the device, and the two kernels that walk it: all rays go through packets and through
/// streams, whose answers must be the same bits.
class Traversal {
public:
    Traversal(const RenderDevice& device, const ProgramOptions& options);

    void upload(const Bvh& bvh, int root);
    /// A tree over these alone.
    void upload(std::span<const PrimitiveRecord> primitives);

    /// Throws std::runtime_error where packets and streams differ; so does `occluded`.
    std::vector<TracedHit> closest(std::span<const TracedRay> rays) const;
    /// Whether something is in the way: ray i carries the radiance (1, 2, 4) to slot i.
    std::vector<bool> occluded(std::span<const TracedRay> rays) const;

private:
    struct Sizes;
    std::vector<TracedHit> closest(const Program& program, std::span<const TracedRay> rays) const;
    std::vector<bool> occluded(const Program& program, std::span<const TracedRay> rays) const;
    void run(cl::Kernel kernel, const Sizes& s, const Buffer<float>& path_state,
             const Buffer<float>& shadow_state, const Buffer<float>& results) const;

    const RenderDevice& d_;
    Program packets_, streams_;
    Buffer<BvhNode> nodes_;
    Buffer<BvhLine> leaves_;
    int root_ = 0;
    float extent_ = 0;
};

} // namespace parhelion::stress
