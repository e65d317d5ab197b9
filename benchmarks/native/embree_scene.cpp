// A triangle mesh in Embree.
#include "benchmarks/native/embree_scene.h"

#include "host/clock.h"

#include <fmt/format.h>

#include <cstring>

namespace parhelion::bench {
namespace {

bool count_bytes(void* total, ssize_t bytes, bool) {
    static_cast<std::atomic<std::int64_t>*>(total)->fetch_add(bytes);
    return true;
}

} // namespace

EmbreeScene::EmbreeScene(const TriangleMesh& mesh, bool robust, int threads)
    : robust_(robust), bytes_(std::make_unique<std::atomic<std::int64_t>>(0)),
      device_(rtcNewDevice(fmt::format("threads={}", threads).c_str())) {
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, bytes_.get());
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    static_assert(sizeof(Point) == 3 * sizeof(float));
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Point), mesh.vertices.size());
    std::memcpy(vertices, mesh.vertices.data(), mesh.vertices.size() * sizeof(Point));
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(Triangle), mesh.triangles.size());
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
    mesh_bytes_ = bytes_->load();
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    auto start = Clock::now();
    rtcCommitScene(scene_);
    commit_seconds_ = seconds_since(start);
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

} // namespace parhelion::bench
