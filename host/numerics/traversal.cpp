// Rays through the kernels, and their answers back.
#include "host/numerics/traversal.h"

#include "host/cl/source.h"
#include "host/parallel.h"
#include "host/twin/wave_memory.h"
#include "host/waves/kernel_arguments.h"

#include <sys/types.h> // ulong, as the kernels call it

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace parhelion::numerics {
namespace {

constexpr int segment = 2048;

template<class T>
Buffer<T> device_copy(const RenderDevice& d, const char* name, const std::vector<T>& values) {
    return Buffer<T>(d.context, d.queue, name, values.data(), values.size());
}

template<class T>
std::vector<T> host_copy(const RenderDevice& d, const Buffer<T>& buffer) {
    std::vector<T> values(buffer.count());
    buffer.read(d.queue, values.data());
    return values;
}

Program compile(const RenderDevice& d, const ProgramOptions& options) {
    return {d.context, d.device, d.cache, program_source({"intersect.cl", "shadow.cl"}, options)};
}

ProgramOptions with_streams(ProgramOptions options, bool streams) {
    options.features.set(feature_ray_streams, streams);
    return options;
}

template<class Answers>
Answers same_answers(Answers packets, const Answers& streams) {
    if (packets != streams) throw std::runtime_error("packets and streams differ");
    return packets;
}

bool same_bits(const TracedHit& a, const TracedHit& b) {
    return std::memcmp(&a, &b, sizeof(TracedHit)) == 0;
}
bool same_bits(bool a, bool b) { return a == b; }

/// Of those that `a` has.
template<class Answer>
std::uint64_t differing(const std::vector<Answer>& a, const std::vector<Answer>& b) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.size(); i++)
        count += !same_bits(a[i], b[i]);
    return count;
}

} // namespace

struct Traversal::Sizes {
    std::size_t rays, segments;
    explicit Sizes(std::size_t n) : rays(n), segments((n + segment - 1) / segment) {}
    std::size_t stride() const { return segments * segment; }
    /// Entries of each segment, twice: of paths and of shadow rays.
    std::vector<int> counts() const {
        std::vector<int> entries(2 * segments);
        for (std::size_t i = 0; i < entries.size(); i++)
            entries[i] = static_cast<int>(std::min<std::size_t>(segment, rays - i / 2 * segment));
        return entries;
    }
};

/// What a kernel reads and writes: the state of paths or of shadow rays, and what those bring.
struct Traversal::Work {
    std::vector<float> state, results;

    static void put_ray(std::vector<float>& state, std::size_t stride, std::size_t i,
                        const TracedRay& r) {
        const float values[] = {r.origin[0],    r.origin[1],    r.origin[2], r.direction[0],
                                r.direction[1], r.direction[2], r.t_max};
        for (std::size_t k = 0; k < std::size(values); k++)
            state[k * stride + i] = values[k];
        state[ray_excluded * stride + i] = std::bit_cast<float>(r.excluded);
    }

    static Work of_paths(Rays rays, const Sizes& s) {
        Work w{std::vector<float>(path_word_count * s.stride()), std::vector<float>(1)};
        for (std::size_t i = 0; i < rays.size(); i++) {
            put_ray(w.state, s.stride(), i, rays[i]);
        }
        return w;
    }

    static Work of_shadow_rays(Rays rays, const Sizes& s) {
        Work w{std::vector<float>(shadow_word_count * s.stride()),
               std::vector<float>(result_field_count * s.stride())};
        for (std::size_t i = 0; i < rays.size(); i++) {
            put_ray(w.state, s.stride(), i, rays[i]);
            for (int channel = 0; channel < 3; channel++)
                w.state[(shadow_contribution + channel) * s.stride() + i] =
                    static_cast<float>(1 << channel);
            w.state[shadow_slot * s.stride() + i] = std::bit_cast<float>(static_cast<int>(i));
        }
        return w;
    }

    std::vector<TracedHit> hits(const Sizes& s) const {
        std::vector<TracedHit> list(s.rays);
        for (std::size_t i = 0; i < s.rays; i++) {
            auto word = [&](int field) { return state[field * s.stride() + i]; };
            list[i] = {word(path_t), word(path_b1), word(path_b2),
                       std::bit_cast<int>(word(path_primitive))};
        }
        return list;
    }

    std::vector<bool> blocked(const Sizes& s) const {
        std::vector<bool> list(s.rays);
        for (std::size_t i = 0; i < s.rays; i++) {
            float r = results[i], g = results[s.stride() + i], b = results[2 * s.stride() + i];
            list[i] = r == 0;
            if (g != 2 * r || b != 4 * r || (r != 0 && r != 1))
                throw std::runtime_error("wrong radiance arrived");
        }
        return list;
    }
};

/// What is asked of rays: a kernel, the state it starts from, and the answers in what it leaves.
template<class Answer>
struct Traversal::Question {
    Stage stage;
    Work (*state)(Rays, const Sizes&);
    std::vector<Answer> (Work::*read)(const Sizes&) const;
};

Traversal::Traversal(const RenderDevice& device, const ProgramOptions& options,
                     std::size_t host_share)
    : d_(device), packets_(compile(device, with_streams(options, false))),
      streams_(compile(device, with_streams(options, true))), host_share_(host_share) {}

void Traversal::upload(const Bvh& bvh, int root) {
    buffers_.bvh_nodes =
        Buffer<BvhNode>(d_.context, d_.queue, "nodes", bvh.nodes.data(), bvh.nodes.size());
    buffers_.bvh_leaves =
        Buffer<BvhLine>(d_.context, d_.queue, "leaves", bvh.leaves.data(), bvh.leaves.size());
    scene_.bvh = bvh;
    scene_.root = root;
    extent_ = bvh_extent(bvh, root);
}

void Traversal::upload(std::span<const PrimitiveRecord> primitives) {
    Bvh bvh;
    int root = bvh_append(bvh, indexed_geometry(primitives));
    upload(bvh, root);
}

template<class Answer>
std::vector<Answer> Traversal::answers(Rays rays, const Question<Answer>& q) {
    Sizes s(rays.size());
    auto ask = [&](const Program& program) {
        Work work = q.state(rays, s);
        run_on_device(program, q.stage, s, work);
        return (work.*q.read)(s);
    };
    std::vector<Answer> found = same_answers(ask(packets_), ask(streams_));
    if (host_share_ > 0) {
        Rays some = rays.first((rays.size() + host_share_ - 1) / host_share_);
        Sizes part(some.size());
        Work work = q.state(some, part);
        run_on_host(q.stage, part, work);
        host_answers_.rays += part.rays;
        host_answers_.differing += differing((work.*q.read)(part), found);
    }
    return found;
}

std::vector<TracedHit> Traversal::closest(Rays rays) {
    return answers<TracedHit>(rays, {Stage::intersect, Work::of_paths, &Work::hits});
}

std::vector<bool> Traversal::occluded(Rays rays) {
    return answers<bool>(rays, {Stage::shadow, Work::of_shadow_rays, &Work::blocked});
}

RenderParams Traversal::params(const Sizes& s) const {
    RenderParams params{};
    params.state_stride = params.result_stride = static_cast<int>(s.stride());
    params.segment_size = params.segment_stride = segment;
    params.root = params.camera_root = scene_.root;
    params.tree_sizes = {extent_, scene_.bvh.side};
    return params;
}

void Traversal::run_on_host(Stage stage, const Sizes& s, Work& work) const {
    WaveMemory<float> memory{WorkSizes{}};
    memory.counts = s.counts();
    memory.statistics.resize(statistic_count * s.segments);
    memory.results = std::move(work.results);
    auto& state = stage == Stage::shadow ? memory.shadow_state : memory.path_state;
    state = std::move(work.state);
    FeatureSet features = FeatureSet::all() - FeatureSet{feature_ray_streams};
    HostLaunch<float> launch{scene_arrays(scene_), params(s), features, WaveParams{}, memory};
    parallel_for(s.segments, [&](std::size_t number) {
        run_work_item(stage, launch, 1, static_cast<int>(number));
    });
    work.state = std::move(state);
    work.results = std::move(memory.results);
}

void Traversal::run_on_device(const Program& program, Stage stage, const Sizes& s,
                              Work& work) const {
    WaveBuffers buffers; // empty where these kernels read nothing
    Buffer<float>& state = stage == Stage::shadow ? buffers.shadow_state : buffers.path_state;
    state = device_copy(d_, "state", work.state);
    buffers.results = device_copy(d_, "results", work.results);
    buffers.counts = device_copy(d_, "counts", s.counts());
    buffers.statistics =
        device_copy(d_, "statistics", std::vector<ulong>(statistic_count * s.segments));
    cl::Kernel kernel = program.kernel(stage_names[static_cast<std::size_t>(stage)]);
    bind_arguments(kernel, buffers_, buffers, Buffer<float>(), params(s));
    kernel.setArg(wave_argument, WaveParams{});
    kernel.setArg(depth_argument, 1);
    d_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(s.segments), cl::NDRange(1));
    d_.queue.finish();
    work.state = host_copy(d_, state);
    work.results = host_copy(d_, buffers.results);
    program.store(d_.cache);
}

} // namespace parhelion::numerics
