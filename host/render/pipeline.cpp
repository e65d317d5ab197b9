// The device side of a render: context, queue, compiled stages, buffers; and launching a stage.
#include "host/render/pipeline.h"

#include "host/render/kernel_arguments.h"

#include <algorithm>

namespace parhelion {
namespace {

/// Results have fewer channels than the film, but for the two of a sample's offset.
constexpr int offset_channels = 2;

int rounded_up(int value, int unit) { return (value + unit - 1) / unit * unit; }

template<class T>
Buffer<T> make_buffer(const RenderDevice& d, const char* name, const LargeVector<T>& values) {
    return Buffer<T>::of(d.context, d.queue, name, values);
}

template<class T>
Buffer<T> make_buffer(const RenderDevice& d, const char* name, const std::vector<T>& values) {
    return Buffer<T>(d.context, d.queue, name, values.data(), values.size());
}

} // namespace

std::size_t WorkBuffers::bytes() const {
#define ADD_BYTES(type, name) +name.bytes()
    return 0 WORK_BUFFERS(ADD_BYTES);
}

WorkSizes work_sizes(const SampleWindow& window, int samples, int lanes, int film_channels,
                     const WorkSplit& split) {
    WorkSizes s;
    s.window = window;
    // What is splatted together must be in one wave.
    int together = window.reach > 0 ? SPLAT_SAMPLES : 1;
    int groups = std::max(together, split.pool_paths / BLOCK_PIXELS);
    // Few samples of many blocks, so that neighbouring pixels share a segment; more where the film
    // is too small to fill the pool.
    constexpr int usual = 16;
    auto blocks = static_cast<std::int64_t>(window.tiles());
    int to_fill = static_cast<int>(std::max<std::int64_t>(usual, groups / blocks));
    s.samples_per_wave = std::min(samples, std::min(to_fill, groups) / together * together);
    s.blocks_per_wave =
        static_cast<int>(std::min<std::int64_t>(groups / s.samples_per_wave, blocks));
    s.path_capacity = s.blocks_per_wave * s.samples_per_wave * BLOCK_PIXELS;
    s.segment_size = lanes == 1 ? std::max(1, split.segment_paths)
                                : rounded_up(std::max(1, split.segment_paths), 16);
    s.segment_size = std::min(s.segment_size, s.path_capacity);
    s.segment_stride = s.segment_size + (lanes == 1 ? 0 : SEGMENT_PADDING);
    s.segments =
        rounded_up((s.path_capacity + s.segment_size - 1) / s.segment_size, split.work_group_size);
    s.film_channels = film_channels;
    return s;
}

Pipeline::Pipeline(RenderDevice& device, const StageOptions& options)
    : device_(device), stages_(compile_stages(device, options)) {}

void Pipeline::upload(const DeviceScene& scene) {
    struct {
        const decltype(scene.bvh.nodes)& bvh_nodes;
        const decltype(scene.bvh.leaves)& bvh_leaves;
        const LargeVector<PrimitiveRecord>& primitives;
        const LargeVector<VertexRecord>& vertices;
        const std::vector<MaterialRecord>& materials;
        const std::vector<LightRecord>& lights;
        const std::vector<LightNodeRecord>& light_nodes;
        const std::vector<int>& light_leaves;
        const std::vector<FilterBin>& filter_table;
        const std::vector<float>& filter_values;
    } arrays{scene.bvh.nodes,        scene.bvh.leaves,        scene.primitives,
             scene.vertices,         scene.materials,         scene.lights,
             scene.light_tree.nodes, scene.light_tree.leaves, scene.filter_table,
             scene.filter_values};
#define UPLOAD(type, name) scene_.name = make_buffer(device_, #name, arrays.name);
    SCENE_BUFFERS(UPLOAD)
}

void Pipeline::allocate(const WorkSizes& s) {
    std::size_t result_channels = s.film_channels + offset_channels;
    std::size_t counted = std::max(s.segments, s.blocks_per_wave);
    work_.path_state = {device_.context, "path_state", path_field_count * s.state_stride()};
    work_.shadow_state = {device_.context, "shadow_state", shadow_field_count * s.state_stride()};
    work_.results = {device_.context, "results", result_channels * s.result_stride()};
    work_.counts = {device_.context, "counts", 2 * static_cast<std::size_t>(s.segments)};
    work_.statistics = {device_.context, "statistics", statistic_count * counted};
    work_.film = {device_.context, "film", 2 * s.film_channels * s.film_stride()};
    // Leftovers behind the last path are read (and ignored): they must be numbers the first time
    // too.
    work_.path_state.fill_zero(device_.queue);
    work_.counts.fill_zero(device_.queue);
    work_.statistics.fill_zero(device_.queue);
    work_.film.fill_zero(device_.queue);
    counts_.resize(work_.counts.count());
}

void bind_arguments(cl::Kernel& kernel, const SceneBuffers& scene, const WorkBuffers& work,
                    const RenderParams& params) {
    cl_uint argument = 0;
#define BIND_SCENE(type, name) kernel.setArg(argument++, scene.name.handle());
#define BIND_WORK(type, name) kernel.setArg(argument++, work.name.handle());
    SCENE_BUFFERS(BIND_SCENE)
    WORK_BUFFERS(BIND_WORK)
    kernel.setArg(params_argument, params);
}

void Pipeline::bind(const RenderParams& params) {
    for (cl::Kernel& kernel : stages_.kernels) {
        bind_arguments(kernel, scene_, work_, params);
        kernel.setArg(depth_argument, 0);
    }
}

void Pipeline::set_wave(const WaveParams& wave) {
    for (cl::Kernel& kernel : stages_.kernels)
        kernel.setArg(wave_argument, wave);
}

void Pipeline::launch(Stage stage, int depth, int work_items, int work_group_size) {
    auto i = static_cast<std::size_t>(stage);
    stages_.kernels[i].setArg(depth_argument, depth);
    std::size_t global = rounded_up(work_items, work_group_size);
    cl::Event event;
    device_.queue.enqueueNDRangeKernel(stages_.kernels[i], cl::NullRange, cl::NDRange(global),
                                       cl::NDRange(work_group_size), nullptr, &event);
    pending_.emplace_back(i, event);
}

std::pair<std::size_t, std::size_t> Pipeline::read_counts() {
    work_.counts.read(device_.queue, counts_.data());
    std::pair<std::size_t, std::size_t> sum{0, 0};
    for (std::size_t i = 0; i < counts_.size(); i += 2) {
        sum.first += counts_[i];
        sum.second += counts_[i + 1];
    }
    return sum;
}

std::vector<float> Pipeline::read_film() {
    std::vector<float> film(work_.film.count());
    work_.film.read(device_.queue, film.data());
    return film;
}

std::array<std::uint64_t, statistic_count> Pipeline::read_statistics() {
    std::vector<ulong> values(work_.statistics.count());
    work_.statistics.read(device_.queue, values.data());
    std::array<std::uint64_t, statistic_count> sums{};
    for (std::size_t i = 0; i < values.size(); i++)
        sums[i % statistic_count] += values[i];
    return sums;
}

void Pipeline::collect_times() {
    device_.queue.finish();
    for (const auto& [stage, event] : pending_) {
        cl_ulong begin = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        cl_ulong end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        stages_.reports[stage].kernel_seconds += 1e-9 * static_cast<double>(end - begin);
        stages_.reports[stage].launches++;
    }
    pending_.clear();
}

void Pipeline::store_programs() const { parhelion::store_programs(device_, stages_); }

std::size_t Pipeline::pool_bytes() const { return work_.bytes() - work_.film.bytes(); }

} // namespace parhelion
