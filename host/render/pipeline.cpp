// The device side of a render: context, queue, compiled stages, buffers; and launching a stage.
#include "host/render/pipeline.h"

#include <algorithm>
#include <future>

namespace parhelion {
namespace {

int rounded_up(int value, int unit) { return (value + unit - 1) / unit * unit; }

// Parameters behind the buffers in KERNEL_PARAMETERS.
#define COUNT_ONE(type, name) +1
constexpr cl_uint buffer_count = 0 SCENE_BUFFERS(COUNT_ONE) WORK_BUFFERS(COUNT_ONE);
constexpr cl_uint params_argument = buffer_count, wave_argument = buffer_count + 1,
                  depth_argument = buffer_count + 2;

} // namespace

std::size_t WorkBuffers::bytes() const {
#define ADD_BYTES(type, name) +name.bytes()
    return 0 WORK_BUFFERS(ADD_BYTES);
}

WorkSizes work_sizes(int crop_width, int crop_height, int samples, int lanes, int film_channels,
                     const WorkSplit& split) {
    WorkSizes s;
    s.blocks_x = (crop_width + 3) / 4;
    s.blocks_y = (crop_height + 3) / 4;
    int groups = std::max(1, split.pool_paths / BLOCK_PIXELS);
    // Few samples of many blocks, so that neighbouring pixels share a segment; more where the film
    // is too small to fill the pool.
    constexpr int usual = 16;
    std::int64_t blocks = static_cast<std::int64_t>(s.blocks_x) * s.blocks_y;
    int to_fill = static_cast<int>(std::max<std::int64_t>(usual, groups / blocks));
    s.samples_per_wave = std::min({samples, to_fill, groups});
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

Pipeline::Pipeline(const Device& device, int lanes, bool portable, std::uint64_t features)
    : context_(device.handle), queue_(context_, device.handle, CL_QUEUE_PROFILING_ENABLE) {
    compile(device, lanes, portable, features);
}

void Pipeline::compile(const Device& device, int lanes, bool portable, std::uint64_t features) {
    std::vector<std::future<Program>> jobs;
    for (std::size_t i = 0; i < stage_count; i++) {
        ProgramOptions options{lanes, features & stage_features(static_cast<Stage>(i)), portable};
        std::string file = std::string(stage_names[i]) + ".cl";
        jobs.push_back(std::async(std::launch::async, [=, this] {
            return Program(context_, device, cache_, file, options);
        }));
        StageReport report;
        report.name = stage_names[i];
        report.features = feature_names(options.features);
        reports_.push_back(report);
    }
    for (std::size_t i = 0; i < stage_count; i++) {
        programs_.push_back(jobs[i].get());
        kernels_.push_back(programs_[i].kernel());
        reports_[i].compile_seconds = programs_[i].seconds();
        reports_[i].cached = programs_[i].from_cache();
    }
}

void Pipeline::upload(const DeviceScene& scene) {
    struct {
        const decltype(scene.bvh.nodes)& bvh_nodes;
        const decltype(scene.bvh.leaves)& bvh_leaves;
        const std::vector<PrimitiveRecord>& primitives;
        const std::vector<VertexRecord>& vertices;
        const std::vector<MaterialRecord>& materials;
        const std::vector<LightRecord>& lights;
        const std::vector<LightAlias>& light_aliases;
        const std::vector<FilterBin>& filter_table;
    } arrays{scene.bvh.nodes, scene.bvh.leaves, scene.primitives,    scene.vertices,
             scene.materials, scene.lights,     scene.light_aliases, scene.filter_table};
#define UPLOAD(type, name)                                                                         \
    scene_.name = Buffer<type>(context_, queue_, #name, arrays.name.data(), arrays.name.size());
    SCENE_BUFFERS(UPLOAD)
}

void Pipeline::allocate(const WorkSizes& s) {
    std::size_t result_channels = std::max(s.film_channels, static_cast<int>(result_field_count));
    std::size_t counted = std::max(s.segments, s.blocks_per_wave);
    work_.path_state = {context_, "path_state", path_field_count * s.state_stride()};
    work_.shadow_state = {context_, "shadow_state", shadow_field_count * s.state_stride()};
    work_.results = {context_, "results", result_channels * s.path_capacity};
    work_.counts = {context_, "counts", 2 * static_cast<std::size_t>(s.segments)};
    work_.statistics = {context_, "statistics", statistic_count * counted};
    work_.film = {context_, "film", 2 * s.film_channels * s.film_pixels()};
    // Leftovers behind the last path are read (and ignored): they must be numbers the first time
    // too.
    work_.path_state.fill_zero(queue_);
    work_.counts.fill_zero(queue_);
    work_.statistics.fill_zero(queue_);
    work_.film.fill_zero(queue_);
    counts_.resize(work_.counts.count());
}

void Pipeline::bind(const RenderParams& params) {
    for (cl::Kernel& kernel : kernels_) {
        cl_uint argument = 0;
#define BIND_SCENE(type, name) kernel.setArg(argument++, scene_.name.handle());
#define BIND_WORK(type, name) kernel.setArg(argument++, work_.name.handle());
        SCENE_BUFFERS(BIND_SCENE)
        WORK_BUFFERS(BIND_WORK)
        kernel.setArg(params_argument, params);
        kernel.setArg(depth_argument, 0);
    }
}

void Pipeline::set_wave(const WaveParams& wave) {
    for (cl::Kernel& kernel : kernels_)
        kernel.setArg(wave_argument, wave);
}

void Pipeline::launch(Stage stage, int depth, int work_items, int work_group_size) {
    auto i = static_cast<std::size_t>(stage);
    kernels_[i].setArg(depth_argument, depth);
    std::size_t global = rounded_up(work_items, work_group_size);
    cl::Event event;
    queue_.enqueueNDRangeKernel(kernels_[i], cl::NullRange, cl::NDRange(global),
                                cl::NDRange(work_group_size), nullptr, &event);
    pending_.emplace_back(i, event);
}

std::pair<std::size_t, std::size_t> Pipeline::read_counts() {
    work_.counts.read(queue_, counts_.data());
    std::pair<std::size_t, std::size_t> sum{0, 0};
    for (std::size_t i = 0; i < counts_.size(); i += 2) {
        sum.first += counts_[i];
        sum.second += counts_[i + 1];
    }
    return sum;
}

std::vector<float> Pipeline::read_film() {
    std::vector<float> film(work_.film.count());
    work_.film.read(queue_, film.data());
    return film;
}

std::array<std::uint64_t, statistic_count> Pipeline::read_statistics() {
    std::vector<ulong> values(work_.statistics.count());
    work_.statistics.read(queue_, values.data());
    std::array<std::uint64_t, statistic_count> sums{};
    for (std::size_t i = 0; i < values.size(); i++)
        sums[i % statistic_count] += values[i];
    return sums;
}

void Pipeline::collect_times() {
    queue_.finish();
    for (const auto& [stage, event] : pending_) {
        cl_ulong begin = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        cl_ulong end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        reports_[stage].kernel_seconds += 1e-9 * static_cast<double>(end - begin);
        reports_[stage].launches++;
    }
    pending_.clear();
}

void Pipeline::store_programs() const {
    for (const Program& program : programs_)
        program.store(cache_);
}

std::size_t Pipeline::pool_bytes() const { return work_.bytes() - work_.film.bytes(); }

} // namespace parhelion
