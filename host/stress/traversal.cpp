// Rays through the kernels, and their answers back.
#include "host/stress/traversal.h"

#include "host/cl/source.h"
#include "host/render/device_scene.h"

#include <sys/types.h> // ulong, as the kernels call it

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace parhelion::stress {
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
    return {d.context, d.device, d.program_cache(),
            program_source({"intersect.cl", "shadow.cl"}, options)};
}

ProgramOptions with_streams(ProgramOptions options, bool streams) {
    std::uint64_t bit = feature_bit(feature_ray_streams);
    options.features = streams ? options.features | bit : options.features & ~bit;
    return options;
}

template<class Answers>
Answers same_answers(Answers packets, const Answers& streams) {
    if (packets != streams) throw std::runtime_error("packets and streams differ");
    return packets;
}

} // namespace

struct Traversal::Sizes {
    std::size_t rays, segments;
    explicit Sizes(std::size_t n) : rays(n), segments((n + segment - 1) / segment) {}
    std::size_t stride() const { return segments * segment; }
};

Traversal::Traversal(const RenderDevice& device, const ProgramOptions& options)
    : d_(device), packets_(compile(device, with_streams(options, false))),
      streams_(compile(device, with_streams(options, true))) {}

void Traversal::upload(const Bvh& bvh, int root) {
    nodes_ = Buffer<BvhNode>(d_.context, d_.queue, "nodes", bvh.nodes.data(), bvh.nodes.size());
    leaves_ = Buffer<BvhLine>(d_.context, d_.queue, "leaves", bvh.leaves.data(), bvh.leaves.size());
    root_ = root;
    extent_ = bvh_extent(bvh, root);
}

void Traversal::upload(std::span<const PrimitiveRecord> primitives) {
    Bvh bvh;
    int root = bvh_append(bvh, primitives);
    upload(bvh, root);
}

std::vector<TracedHit> Traversal::closest(std::span<const TracedRay> rays) const {
    return same_answers(closest(packets_, rays), closest(streams_, rays));
}

std::vector<bool> Traversal::occluded(std::span<const TracedRay> rays) const {
    return same_answers(occluded(packets_, rays), occluded(streams_, rays));
}

std::vector<TracedHit> Traversal::closest(const Program& program,
                                          std::span<const TracedRay> rays) const {
    Sizes s(rays.size());
    std::vector<float> state(path_field_count * s.stride());
    for (std::size_t i = 0; i < rays.size(); i++) {
        const TracedRay& r = rays[i];
        const float values[] = {r.origin[0],    r.origin[1],    r.origin[2], r.direction[0],
                                r.direction[1], r.direction[2], r.t_max};
        for (std::size_t k = 0; k < std::size(values); k++)
            state[k * s.stride() + i] = values[k];
        state[path_excluded * s.stride() + i] = std::bit_cast<float>(r.excluded);
    }
    Buffer<float> path_state = device_copy(d_, "path_state", state);
    run(program.kernel("intersect"), s, path_state, path_state, path_state);
    state = host_copy(d_, path_state);
    std::vector<TracedHit> hits(rays.size());
    for (std::size_t i = 0; i < rays.size(); i++) {
        auto word = [&](int field) { return state[field * s.stride() + i]; };
        hits[i] = {word(path_t), word(path_b1), word(path_b2),
                   std::bit_cast<int>(word(path_primitive))};
    }
    return hits;
}

std::vector<bool> Traversal::occluded(const Program& program,
                                      std::span<const TracedRay> rays) const {
    Sizes s(rays.size());
    std::vector<float> state(shadow_field_count * s.stride());
    for (std::size_t i = 0; i < rays.size(); i++) {
        const TracedRay& r = rays[i];
        const float values[] = {r.origin[0],
                                r.origin[1],
                                r.origin[2],
                                r.direction[0],
                                r.direction[1],
                                r.direction[2],
                                r.t_max,
                                1,
                                2,
                                4};
        for (std::size_t k = 0; k < std::size(values); k++)
            state[k * s.stride() + i] = values[k];
        state[shadow_slot * s.stride() + i] = std::bit_cast<float>(static_cast<int>(i));
        state[shadow_excluded * s.stride() + i] = std::bit_cast<float>(r.excluded);
    }
    Buffer<float> shadow_state = device_copy(d_, "shadow_state", state);
    Buffer<float> results(d_.context, "results", result_field_count * s.stride());
    results.fill_zero(d_.queue);
    run(program.kernel("shadow"), s, shadow_state, shadow_state, results);
    std::vector<float> found = host_copy(d_, results);
    std::vector<bool> blocked(rays.size());
    for (std::size_t i = 0; i < rays.size(); i++) {
        float r = found[i], g = found[s.stride() + i], b = found[2 * s.stride() + i];
        blocked[i] = r == 0;
        if (g != 2 * r || b != 4 * r || (r != 0 && r != 1))
            throw std::runtime_error("wrong radiance arrived");
    }
    return blocked;
}

void Traversal::run(cl::Kernel kernel, const Sizes& s, const Buffer<float>& path_state,
                    const Buffer<float>& shadow_state, const Buffer<float>& results) const {
    std::vector<int> entries(2 * s.segments);
    for (std::size_t i = 0; i < entries.size(); i++)
        entries[i] = static_cast<int>(std::min<std::size_t>(segment, s.rays - i / 2 * segment));
    Buffer<int> counts = device_copy(d_, "counts", entries);
    Buffer<ulong> statistics =
        device_copy(d_, "statistics", std::vector<ulong>(statistic_count * s.segments));
    const Buffer<BvhNode>& bvh_nodes = nodes_;
    const Buffer<BvhLine>& bvh_leaves = leaves_;
    // Not read by these kernels.
    Buffer<int> primitives, vertices, materials, lights, light_nodes, light_leaves, energy_tables,
        filter_table, filter_values, bad_samples, film;
    RenderParams params{};
    params.state_stride = params.result_stride = static_cast<int>(s.stride());
    params.segment_size = params.segment_stride = segment;
    params.root = params.camera_root = root_;
    params.extent = extent_;
    cl_uint argument = 0;
#define SET_BUFFER(type, name) kernel.setArg(argument++, name.handle());
    SCENE_BUFFERS(SET_BUFFER)
    WORK_BUFFERS(SET_BUFFER)
#undef SET_BUFFER
    kernel.setArg(argument++, params);
    kernel.setArg(argument++, WaveParams{});
    kernel.setArg(argument++, 1);
    d_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(s.segments), cl::NDRange(1));
    d_.queue.finish();
}

} // namespace parhelion::stress
