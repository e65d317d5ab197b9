// Rays through the kernels `intersect` and `shadow`, on path and shadow states filled
// by hand: on the device, and compiled as C++.
#pragma once

#include "host/bvh/bvh.h"
#include "host/cl/program_options.h"
#include "host/flatten/device_scene.h"
#include "host/numerics/ray_states.h"
#include "host/waves/stages.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace parhelion {
class Program;
struct RenderDevice;
} // namespace parhelion

namespace parhelion::numerics {

/// Rays that went through the kernels as C++ too, and answers of other bits than the device's.
struct HostAnswers {
    std::uint64_t rays = 0, differing = 0;
};

/// A tree on the device, and the two kernels that walk it: all rays go through packets and through
/// streams, whose answers must be the same bits. Memory grows with the rays of a call.
class Traversal {
public:
    /// Of the rays of every call the first of `host_share` parts goes through the kernels as C++ as
    /// well; 0: none of it.
    Traversal(const RenderDevice& device, const ProgramOptions& options,
              std::size_t host_share = 0);
    ~Traversal();

    void upload(const Bvh& bvh, int root);
    /// A tree over these alone.
    void upload(std::span<const PrimitiveRecord> primitives);

    /// Throws std::runtime_error where packets and streams differ; so does `occluded`.
    std::vector<TracedHit> closest(std::span<const TracedRay> rays);
    /// Whether something is in the way: ray i carries the radiance (1, 2, 4) to slot i.
    std::vector<bool> occluded(std::span<const TracedRay> rays);
    /// Since the last call.
    HostAnswers take_host_answers() { return std::exchange(host_answers_, {}); }

private:
    struct Work;
    using Rays = std::span<const TracedRay>;
    template<class Answer>
    struct Question;
    template<class Answer>
    std::vector<Answer> answers(Rays rays, const Question<Answer>& question);
    void run_on_device(const Program& program, Stage stage, const RayLayout& layout,
                       Work& work) const;
    void run_on_host(Stage stage, const RayLayout& layout, Work& work) const;
    RenderParams params(const RayLayout& layout) const;

    struct Device; ///< programs and buffers
    std::unique_ptr<Device> device_;
    std::size_t host_share_;
    HostAnswers host_answers_;
    DeviceScene scene_; ///< the host's: a tree and nothing else
    float extent_ = 0;
};

} // namespace parhelion::numerics
