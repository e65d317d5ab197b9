// Embree as a tracer, through each of its ways to hand over rays.
#include "benchmarks/native/embree_rays.h"

#include "host/clock.h"

#include <fmt/format.h>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <pmmintrin.h>
#include <type_traits>
#include <xmmintrin.h>

namespace parhelion::bench {
namespace {

/// A single ray's or packet's field as an array.
template<class T>
T& field(T& value, std::size_t) {
    return value;
}
template<class T, std::size_t n>
T& field(T (&values)[n], std::size_t k) {
    return values[k];
}

/// `calls` counts what one structure holds: 1, 4, 8 or 16 rays.
#define PACKET_API(n)                                                                              \
    struct Packets##n {                                                                            \
        using RayHit = RTCRayHit##n;                                                               \
        static constexpr std::size_t size = n;                                                     \
        static constexpr const char* name = #n;                                                    \
        static void trace(RTCScene scene, RTCIntersectContext* context, RayHit* rays,              \
                          std::size_t count, bool any_hit) {                                       \
            alignas(64) int valid[n];                                                              \
            std::fill(std::begin(valid), std::end(valid), -1);                                     \
            for (std::size_t i = 0; i < count; i++) {                                              \
                if (any_hit)                                                                       \
                    rtcOccluded##n(valid, scene, context, &rays[i].ray);                           \
                else                                                                               \
                    rtcIntersect##n(valid, scene, context, rays + i);                              \
            }                                                                                      \
        }                                                                                          \
    };
PACKET_API(4)
PACKET_API(8)
PACKET_API(16)

struct Single {
    using RayHit = RTCRayHit;
    static constexpr std::size_t size = 1;
    static constexpr const char* name = "1";
    static void trace(RTCScene scene, RTCIntersectContext* context, RayHit* rays, std::size_t count,
                      bool any_hit) {
        for (std::size_t i = 0; i < count; i++) {
            if (any_hit)
                rtcOccluded1(scene, context, &rays[i].ray);
            else
                rtcIntersect1(scene, context, rays + i);
        }
    }
};

struct Stream {
    using RayHit = RTCRayHit;
    static constexpr std::size_t size = 1;
    static constexpr const char* name = "1M";
    static void trace(RTCScene scene, RTCIntersectContext* context, RayHit* rays, std::size_t count,
                      bool any_hit) {
        constexpr std::size_t most = 256;
        for (std::size_t i = 0; i < count; i += most) {
            auto m = static_cast<unsigned>(std::min(most, count - i));
            if (any_hit)
                rtcOccluded1M(scene, context, &rays[i].ray, m, sizeof(RayHit));
            else
                rtcIntersect1M(scene, context, rays + i, m, sizeof(RayHit));
        }
    }
};

template<class Api>
class EmbreeTracer final : public Tracer {
public:
    EmbreeTracer(const EmbreeScene& scene, int threads, bool coherent)
        : scene_(scene), arena_(threads), coherent_(coherent) {}

    std::string name() const override {
        return fmt::format("Embree {}{}{}", Api::name, coherent_ ? " coherent" : "",
                           scene_.robust() ? " robust" : "");
    }

    void prepare(std::span<const Ray> rays, int, bool any_hit) override {
        any_hit_ = any_hit;
        count_ = rays.size();
        packets_.resize((count_ + Api::size - 1) / Api::size);
        // What is left of the last packet repeats the last ray.
        for (std::size_t i = 0; i < packets_.size() * Api::size; i++)
            put(packets_[i / Api::size], i % Api::size, rays[std::min(i, count_ - 1)]);
    }

    double trace() override {
        auto start = Clock::now();
        arena_.execute([&] {
            constexpr std::size_t grain = 2048 / Api::size;
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, packets_.size(), grain),
                              [&](const auto& r) { trace_range(r.begin(), r.size()); });
        });
        return seconds_since(start);
    }

    std::vector<Hit> hits() override {
        std::vector<Hit> found(count_);
        for (std::size_t i = 0; i < count_; i++)
            found[i] = get(packets_[i / Api::size], i % Api::size);
        return found;
    }

private:
    using RayHit = typename Api::RayHit;

    static void put(RayHit& p, std::size_t k, const Ray& r) {
        field(p.ray.org_x, k) = r.origin[0];
        field(p.ray.org_y, k) = r.origin[1];
        field(p.ray.org_z, k) = r.origin[2];
        field(p.ray.dir_x, k) = r.direction[0];
        field(p.ray.dir_y, k) = r.direction[1];
        field(p.ray.dir_z, k) = r.direction[2];
        field(p.ray.tnear, k) = 0;
        field(p.ray.tfar, k) = r.t_max;
        field(p.ray.time, k) = 0;
        field(p.ray.mask, k) = ~0u;
        field(p.ray.flags, k) = 0;
        field(p.ray.id, k) = 0;
        field(p.hit.geomID, k) = field(p.hit.primID, k) = RTC_INVALID_GEOMETRY_ID;
    }

    Hit get(RayHit& p, std::size_t k) const {
        float t = field(p.ray.tfar, k);
        if (any_hit_) return {t, 0, 0, t < 0 ? 0 : -1}; // an occluded ray ends at -inf
        bool hit = field(p.hit.geomID, k) != RTC_INVALID_GEOMETRY_ID;
        return {t, field(p.hit.u, k), field(p.hit.v, k),
                hit ? static_cast<int>(field(p.hit.primID, k)) : -1};
    }

    void trace_range(std::size_t first, std::size_t count) {
        unsigned before = _mm_getcsr(); // Embree asks for denormals to be flushed
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags =
            coherent_ ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        Api::trace(scene_.handle(), &context, packets_.data() + first, count, any_hit_);
        _mm_setcsr(before);
    }

    const EmbreeScene& scene_;
    tbb::task_arena arena_;
    bool coherent_, any_hit_ = false;
    std::size_t count_ = 0;
    std::vector<RayHit> packets_;
};

} // namespace

std::vector<std::unique_ptr<Tracer>> embree_tracers(const EmbreeScene& scene, int threads,
                                                    bool with_coherent) {
    std::vector<std::unique_ptr<Tracer>> tracers;
    auto add = [&](auto api, bool coherent) {
        using Api = decltype(api);
        tracers.push_back(std::make_unique<EmbreeTracer<Api>>(scene, threads, coherent));
    };
    for (bool coherent : {false, true}) {
        if (coherent && !with_coherent) continue;
        add(Single{}, coherent);
        add(Packets4{}, coherent);
        add(Packets8{}, coherent);
        add(Packets16{}, coherent);
        add(Stream{}, coherent);
    }
    return tracers;
}

} // namespace parhelion::bench
