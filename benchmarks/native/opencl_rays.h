// Our stage kernels `intersect` and `shadow` as a tracer.
#pragma once

#include "benchmarks/native/tracer.h"
#include "host/bvh/bvh.h"
#include "host/cl/buffer.h"
#include "host/waves/device_waves.h"

namespace parhelion::bench {

/// Launches the kernels on path states as the renderer leaves them: a wave in segments, one
/// work-item a segment.
class OpenClTracer final : public Tracer {
public:
    /// Compiles the kernels for triangles alone. `device` must outlive it.
    OpenClTracer(RenderDevice& device, const Bvh& bvh, int root, std::size_t primitives);

    std::string name() const override { return "Parhelion"; }
    void prepare(std::span<const Ray> rays, int depth, bool any_hit) override;
    double trace() override;
    std::vector<Hit> hits() override;

private:
    template<class T>
    void write(const Buffer<T>& to, const std::vector<T>& values);
    template<class T>
    std::vector<T> read(const Buffer<T>& from);

    RenderDevice& device_;
    WorkSplit split_;
    WorkSizes sizes_;
    SceneBuffers scene_; ///< a kernel does not keep its arguments alive
    WaveBuffers work_;
    Buffer<cl_uint> film_;
    cl::Kernel intersect_, shadow_;
    std::size_t count_ = 0;
    bool any_hit_ = false;
};

} // namespace parhelion::bench
