// Our stage kernels `intersect` and `shadow` as a tracer.
#include "benchmarks/native/opencl_rays.h"

#include "host/flatten/scene_features.h"
#include "host/waves/kernel_arguments.h"

#include <sys/types.h> // ulong, as the kernels call it

#include <algorithm>
#include <bit>

namespace parhelion::bench {
namespace {

/// Entry of path i: segments stand apart by their padding.
std::size_t entry(const WorkSizes& s, std::size_t i) {
    auto size = static_cast<std::size_t>(s.segment_size);
    return i / size * static_cast<std::size_t>(s.segment_stride) + i % size;
}

float as_float(int i) { return std::bit_cast<float>(i); }

/// The fields that both states begin with.
void lay_out(const Ray& r, float* at, std::size_t stride) {
    for (std::size_t axis = 0; axis < 3; axis++) {
        at[(ray_origin + axis) * stride] = r.origin[axis];
        at[(ray_direction + axis) * stride] = r.direction[axis];
    }
    at[ray_t * stride] = r.t_max;
    at[ray_excluded * stride] = as_float(r.excluded);
}

} // namespace

OpenClTracer::OpenClTracer(RenderDevice& device, const Bvh& bvh, int root, std::size_t primitives)
    : device_(device) {
    int lanes = device.device.lanes();
    ProgramOptions options{lanes, {feature_shape_triangle}, false};
    options.features.set(feature_ray_streams, traced_in_streams(primitives));
    Program program(device.context, device.device, device.cache,
                    program_source({"intersect.cl", "shadow.cl"}, options));
    intersect_ = program.kernel("intersect");
    shadow_ = program.kernel("shadow");

    constexpr int side = 4 * 64; // pixels: with 1 sample they fill the pool
    static_assert(side * side == wave_rays);
    Film film;
    film.width = film.height = film.crop_width = film.crop_height = side;
    film.filter.kind = FilterKind::box;
    split_.streams = 1;
    sizes_ = work_sizes({sample_window(film)}, 1, lanes, split_);
    work_ = wave_buffers(device.context, device.queue, buffer_counts(sizes_));
    film_ = {device.context, "film", 1};

    scene_.bvh_nodes = {device.context, device.queue, "nodes", bvh.nodes.data(), bvh.nodes.size()};
    scene_.bvh_leaves = {device.context, device.queue, "leaves", bvh.leaves.data(),
                         bvh.leaves.size()};
    RenderParams params{};
    params.result_stride = static_cast<int>(sizes_.result_stride());
    params.state_stride = static_cast<int>(sizes_.state_stride());
    params.segment_size = sizes_.segment_size;
    params.segment_stride = sizes_.segment_stride;
    params.film_width = params.film_height = side;
    params.window_width = params.window_height = side;
    params.blocks_x = sizes_.film.window.blocks_x;
    params.root = params.camera_root = root;
    params.tree_sizes = {bvh_extent(bvh, root), bvh.side};
    bind_arguments(intersect_, scene_, work_, film_, params);
    bind_arguments(shadow_, scene_, work_, film_, params);
}

void OpenClTracer::prepare(std::span<const Ray> rays, int depth, bool any_hit) {
    any_hit_ = any_hit;
    count_ = rays.size();
    work_.statistics.fill_zero(device_.queue);
    work_.results.fill_zero(device_.queue);
    std::vector<int> counts(work_.counts.count());
    for (std::size_t i = 0; i < counts.size(); i++) {
        std::size_t first = i / 2 * static_cast<std::size_t>(sizes_.segment_size);
        std::size_t left = count_ > first ? count_ - first : 0;
        counts[i] = static_cast<int>(std::min(left, static_cast<std::size_t>(sizes_.segment_size)));
    }
    device_.queue.enqueueWriteBuffer(work_.counts.handle(), CL_TRUE, 0, work_.counts.bytes(),
                                     counts.data());
    if (any_hit)
        fill_shadows(rays);
    else
        fill_paths(rays);
    cl::Kernel& kernel = any_hit ? shadow_ : intersect_;
    constexpr std::size_t block = BLOCK_PIXELS;
    kernel.setArg(wave_argument,
                  WaveParams{0, static_cast<int>((count_ + block - 1) / block), 0, 1});
    kernel.setArg(depth_argument, depth);
}

void OpenClTracer::fill_paths(std::span<const Ray> rays) {
    state_.resize(work_.path_state.count());
    std::size_t stride = sizes_.state_stride();
    for (std::size_t i = 0; i < rays.size(); i++) {
        const Ray& r = rays[i];
        float* at = state_.data() + entry(sizes_, i);
        lay_out(r, at, stride);
        at[path_slot * stride] = as_float(static_cast<int>(i));
    }
    device_.queue.enqueueWriteBuffer(work_.path_state.handle(), CL_TRUE, 0,
                                     work_.path_state.bytes(), state_.data());
}

/// Every ray brings the radiance (1, 1, 1) to its own slot.
void OpenClTracer::fill_shadows(std::span<const Ray> rays) {
    state_.resize(work_.shadow_state.count());
    std::size_t stride = sizes_.state_stride();
    for (std::size_t i = 0; i < rays.size(); i++) {
        const Ray& r = rays[i];
        float* at = state_.data() + entry(sizes_, i);
        lay_out(r, at, stride);
        for (int channel = 0; channel < 3; channel++)
            at[(shadow_contribution + channel) * stride] = 1;
        at[shadow_slot * stride] = as_float(static_cast<int>(i));
    }
    device_.queue.enqueueWriteBuffer(work_.shadow_state.handle(), CL_TRUE, 0,
                                     work_.shadow_state.bytes(), state_.data());
}

double OpenClTracer::trace() {
    cl::Event event;
    device_.queue.enqueueNDRangeKernel(any_hit_ ? shadow_ : intersect_, cl::NullRange,
                                       cl::NDRange(static_cast<std::size_t>(sizes_.segments)),
                                       cl::NDRange(split_.work_group_size), nullptr, &event);
    event.wait();
    return 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                      event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
}

std::vector<Hit> OpenClTracer::hits() {
    std::vector<Hit> found(count_);
    if (any_hit_) {
        std::vector<float> results(work_.results.count());
        work_.results.read(device_.queue, results.data());
        const float* r = results.data() + result_r * sizes_.result_stride();
        for (std::size_t i = 0; i < count_; i++)
            found[i] = {0, 0, 0, r[i] == 0 ? 0 : -1};
        return found;
    }
    work_.path_state.read(device_.queue, state_.data());
    std::size_t stride = sizes_.state_stride();
    for (std::size_t i = 0; i < count_; i++) {
        const float* at = state_.data() + entry(sizes_, i);
        found[i] = {at[path_t * stride], at[path_b1 * stride], at[path_b2 * stride],
                    std::bit_cast<int>(at[path_primitive * stride])};
    }
    return found;
}

} // namespace parhelion::bench
