// A triangle mesh in Embree.
#pragma once

#include "benchmarks/native/triangle_scene.h"

#include <embree3/rtcore.h>

#include <atomic>
#include <cstddef>
#include <memory>

namespace parhelion::bench {

/// The mesh committed at medium build quality.
class EmbreeScene {
public:
    EmbreeScene(const TriangleMesh& mesh, bool robust, int threads);
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene();

    RTCScene handle() const { return scene_; }
    bool robust() const { return robust_; }
    double commit_seconds() const { return commit_seconds_; }
    /// What Embree has allocated, without the copies of vertices and indices.
    std::size_t bytes() const { return static_cast<std::size_t>(bytes_->load() - mesh_bytes_); }

private:
    bool robust_;
    double commit_seconds_ = 0;
    std::unique_ptr<std::atomic<std::int64_t>> bytes_; ///< its address is Embree's
    std::int64_t mesh_bytes_ = 0;
    RTCDevice device_;
    RTCScene scene_ = nullptr;
};

} // namespace parhelion::bench
