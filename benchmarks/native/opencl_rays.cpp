// Our stage kernels `intersect` and `shadow` as a tracer.
#include "benchmarks/native/opencl_rays.h"

#include "host/flatten/scene_features.h"
#include "host/waves/kernel_arguments.h"

#include <sys/types.h> // ulong, as the kernels call it

namespace parhelion::bench {
namespace {

numerics::RayLayout layout_of(std::size_t rays, const WorkSizes& s) {
    return {rays, static_cast<std::size_t>(s.segments), static_cast<std::size_t>(s.segment_size),
            static_cast<std::size_t>(s.segment_stride), s.state_stride()};
}

} // namespace

OpenClTracer::OpenClTracer(RenderDevice& device, const Bvh& bvh, int root, std::size_t primitives)
    : device_(device) {
    int lanes = device.device.tracing_lanes();
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
    sizes_ = work_sizes(film_layout(film, {}, {}), 1, lanes, split_);
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
    params.root = params.camera_root = params.blocking_root = root;
    params.tree_sizes = {bvh_extent(bvh, root), bvh.side};
    bind_arguments(intersect_, scene_, work_, film_, params);
    bind_arguments(shadow_, scene_, work_, film_, params);
}

void OpenClTracer::prepare(std::span<const Ray> rays, int depth, bool any_hit) {
    any_hit_ = any_hit;
    count_ = rays.size();
    work_.statistics.fill_zero(device_.queue);
    work_.results.fill_zero(device_.queue);
    auto layout = layout_of(count_, sizes_);
    write(work_.counts, numerics::segment_counts(layout));
    if (any_hit)
        write(work_.shadow_state, numerics::shadow_state(rays, layout));
    else
        write(work_.path_state, numerics::path_state(rays, layout));
    cl::Kernel& kernel = any_hit ? shadow_ : intersect_;
    constexpr std::size_t block = BLOCK_PIXELS;
    kernel.setArg(wave_argument,
                  WaveParams{static_cast<int>((count_ + block - 1) / block), 1, 0, 0});
    kernel.setArg(depth_argument, depth);
}

template<class T>
void OpenClTracer::write(const Buffer<T>& to, const std::vector<T>& values) {
    device_.queue.enqueueWriteBuffer(to.handle(), CL_TRUE, 0, values.size() * sizeof(T),
                                     values.data());
}

template<class T>
std::vector<T> OpenClTracer::read(const Buffer<T>& from) {
    std::vector<T> values(from.count());
    from.read(device_.queue, values.data());
    return values;
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
    if (!any_hit_) return numerics::read_hits(read(work_.path_state), layout_of(count_, sizes_));
    std::vector<Hit> found;
    for (bool blocked : numerics::read_blocked(read(work_.results), count_, sizes_.result_stride()))
        found.push_back({0, 0, 0, blocked ? 0 : -1});
    return found;
}

} // namespace parhelion::bench
