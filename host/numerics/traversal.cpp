// Rays through the kernels, and their answers back.
#include "host/numerics/traversal.h"

#include "host/cl/source.h"
#include "host/parallel.h"
#include "host/twin/wave_memory.h"
#include "host/waves/buffers.h"
#include "host/waves/kernel_arguments.h"
#include "host/waves/render_device.h"

#include <sys/types.h> // ulong, as the kernels call it

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace parhelion::numerics {
namespace {

/// Without room beyond its rays.
RayLayout layout_of(std::size_t rays) {
    constexpr std::size_t segment = 2048;
    std::size_t segments = (rays + segment - 1) / segment;
    return {rays, segments, segment, segment, segments * segment};
}

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

/// What is in the way of a ray is: there are no materials that light shines through.
FeatureSet of_geometry(FeatureSet features, bool streams) {
    features.set(feature_ray_streams, streams);
    features.set(feature_clear_shadows, false);
    features.set(feature_light_groups, false); // these rays bring light of none
    return features;
}

ProgramOptions with_streams(ProgramOptions options, bool streams) {
    options.features = of_geometry(options.features, streams);
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

/// What a kernel reads and writes: the state of paths or of shadow rays, and what those bring.
struct Traversal::Work {
    std::vector<float> state, results;

    static Work of_paths(Rays rays, const RayLayout& layout) {
        return {path_state(rays, layout), std::vector<float>(1)};
    }
    static Work of_shadow_rays(Rays rays, const RayLayout& layout) {
        return {shadow_state(rays, layout), std::vector<float>(result_field_count * layout.stride)};
    }
    std::vector<TracedHit> hits(const RayLayout& layout) const { return read_hits(state, layout); }
    std::vector<bool> blocked(const RayLayout& layout) const {
        return read_blocked(results, layout.rays, layout.stride);
    }
};

/// What is asked of rays: a kernel, the state it starts from, and the answers in what it leaves.
template<class Answer>
struct Traversal::Question {
    Stage stage;
    Work (*state)(Rays, const RayLayout&);
    std::vector<Answer> (Work::*read)(const RayLayout&) const;
};

struct Traversal::Device {
    const RenderDevice& device;
    Program packets, streams;
    SceneBuffers buffers; ///< its tree alone

    Device(const RenderDevice& d, const ProgramOptions& options)
        : device(d), packets(compile(d, with_streams(options, false))),
          streams(compile(d, with_streams(options, true))) {}
};

Traversal::Traversal(const RenderDevice& device, const ProgramOptions& options,
                     std::size_t host_share)
    : device_(std::make_unique<Device>(device, options)), host_share_(host_share) {}

Traversal::~Traversal() = default;

void Traversal::upload(const Bvh& bvh, int root) {
    const RenderDevice& d = device_->device;
    device_->buffers.bvh_nodes =
        Buffer<BvhNode>(d.context, d.queue, "nodes", bvh.nodes.data(), bvh.nodes.size());
    device_->buffers.bvh_leaves =
        Buffer<BvhLine>(d.context, d.queue, "leaves", bvh.leaves.data(), bvh.leaves.size());
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
    RayLayout layout = layout_of(rays.size());
    auto ask = [&](const Program& program) {
        Work work = q.state(rays, layout);
        run_on_device(program, q.stage, layout, work);
        return (work.*q.read)(layout);
    };
    std::vector<Answer> found = same_answers(ask(device_->packets), ask(device_->streams));
    if (host_share_ > 0) {
        Rays some = rays.first((rays.size() + host_share_ - 1) / host_share_);
        RayLayout part = layout_of(some.size());
        Work work = q.state(some, part);
        run_on_host(q.stage, part, work);
        host_answers_.rays += some.size();
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

RenderParams Traversal::params(const RayLayout& layout) const {
    RenderParams params{};
    params.state_stride = params.result_stride = static_cast<int>(layout.stride);
    params.segment_size = static_cast<int>(layout.size);
    params.segment_stride = static_cast<int>(layout.pitch);
    params.root = params.camera_root = params.blocking_root = scene_.root;
    params.tree_sizes = {extent_, scene_.bvh.side};
    return params;
}

void Traversal::run_on_host(Stage stage, const RayLayout& layout, Work& work) const {
    WaveMemory<float> memory{WorkSizes{}};
    memory.counts = segment_counts(layout);
    memory.statistics.resize(statistic_count * layout.segments);
    memory.results = std::move(work.results);
    auto& state = stage == Stage::shadow ? memory.shadow_state : memory.path_state;
    state = std::move(work.state);
    FeatureSet features = of_geometry(FeatureSet::all(), false);
    HostLaunch<float> launch{scene_arrays(scene_), params(layout), features, WaveParams{}, memory};
    parallel_for(layout.segments, [&](std::size_t number) {
        run_work_item(stage, launch, 1, static_cast<int>(number));
    });
    work.state = std::move(state);
    work.results = std::move(memory.results);
}

void Traversal::run_on_device(const Program& program, Stage stage, const RayLayout& layout,
                              Work& work) const {
    const RenderDevice& d = device_->device;
    WaveBuffers buffers; // empty where these kernels read nothing
    Buffer<float>& state = stage == Stage::shadow ? buffers.shadow_state : buffers.path_state;
    state = device_copy(d, "state", work.state);
    buffers.results = device_copy(d, "results", work.results);
    buffers.counts = device_copy(d, "counts", segment_counts(layout));
    buffers.statistics =
        device_copy(d, "statistics", std::vector<ulong>(statistic_count * layout.segments));
    cl::Kernel kernel = program.kernel(stage_names[static_cast<std::size_t>(stage)]);
    bind_arguments(kernel, device_->buffers, buffers, Buffer<cl_uint>(), params(layout));
    kernel.setArg(wave_argument, WaveParams{});
    kernel.setArg(depth_argument, 1);
    d.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(layout.segments),
                                 cl::NDRange(1));
    d.queue.finish();
    work.state = host_copy(d, state);
    work.results = host_copy(d, buffers.results);
    program.store(d.cache);
}

} // namespace parhelion::numerics
