// A pool of paths with a queue of its own: launches the stages of one wave after the other.
#include "host/waves/wave_stream.h"

#include "host/error.h"
#include "host/waves/kernel_arguments.h"
#include "kernels/device/bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace parhelion {
namespace {

#define BUFFER_NAME(type, name) #name,
constexpr std::array buffer_names{SCENE_BUFFERS(BUFFER_NAME) WORK_BUFFERS(BUFFER_NAME) "no buffer"};

BufferSizes buffer_sizes(const SceneBuffers& scene, const WaveBuffers& work,
                         const Buffer<float>& film) {
#define SCENE_SIZE(type, name) scene.name.bytes(),
#define WAVE_SIZE(type, name) work.name.bytes(),
    return {{SCENE_BUFFERS(SCENE_SIZE) WAVE_BUFFERS(WAVE_SIZE) film.bytes()}};
}

int rounded_up(int value, int unit) { return (value + unit - 1) / unit * unit; }

} // namespace

std::size_t WaveBuffers::bytes() const {
#define ADD_BYTES(type, name) +name.bytes()
    return 0 WAVE_BUFFERS(ADD_BYTES);
}

WorkSizes work_sizes(const FilmLayout& film, int samples, int lanes, const WorkSplit& split) {
    WorkSizes s;
    s.film = film;
    s.streams = split.streams;
    s.work_group_size = split.work_group_size;
    // What is added up together must be in one wave.
    constexpr int together = FILM_SAMPLES;
    int groups = std::max(together, split.pool_paths / split.streams / BLOCK_PIXELS);
    // Few samples of many blocks, so that neighbouring pixels share a segment; more where the film
    // is too small to fill the pool.
    constexpr int usual = 16;
    // Every stream has blocks of its own.
    std::int64_t streams = split.streams;
    std::int64_t blocks = (static_cast<std::int64_t>(film.window.tiles()) + streams - 1) / streams;
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
    if (s.state_stride() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw InputError(
            fmt::format("{} segments of {} paths are more than the device counts (--pool-paths, "
                        "--segment-paths, --work-group-size; accepted: 2^31 paths together)",
                        s.segments, s.segment_size));
    return s;
}

void bind_arguments(cl::Kernel& kernel, const SceneBuffers& scene, const WaveBuffers& work,
                    const Buffer<float>& film, const RenderParams& params) {
    cl_uint argument = 0;
#define BIND_SCENE(type, name) kernel.setArg(argument++, scene.name.handle());
#define BIND_WAVE(type, name) kernel.setArg(argument++, work.name.handle());
    SCENE_BUFFERS(BIND_SCENE)
    WAVE_BUFFERS(BIND_WAVE)
    kernel.setArg(argument++, film.handle());
    kernel.setArg(params_argument, params);
}

WaveStream::WaveStream(const RenderDevice& device, const StagePrograms& programs,
                       const WorkSizes& s)
    : queue_(device.context, device.device.handle, CL_QUEUE_PROFILING_ENABLE),
      no_film_(device.context, "film", 0), outside_(device.context, "outside", 1),
      checked_(programs.checked), work_group_size_(s.work_group_size) {
    for (std::size_t stage = 0; stage < stage_count; stage++)
        kernels_.push_back(programs.programs[stage].kernel(stage_names[stage]));
    std::size_t counted = std::max(s.segments, s.blocks_per_wave);
    const cl::Context& context = device.context;
    work_.path_state = {context, "path_state", path_word_count * s.state_stride()};
    work_.shadow_state = {context, "shadow_state", shadow_word_count * s.state_stride()};
    work_.results = {context, "results", s.film.result_channels() * s.result_stride()};
    work_.counts = {context, "counts", 2 * static_cast<std::size_t>(s.segments)};
    work_.statistics = {context, "statistics", statistic_count * counted};
    work_.bad_samples = {context, "bad_samples", s.bad_sample_words()};
    // Leftovers behind the last path are read (and ignored): they must be numbers the first time
    // too.
    work_.path_state.fill_zero(queue_);
    outside_.fill_zero(queue_);
    work_.counts.fill_zero(queue_);
    work_.statistics.fill_zero(queue_);
    work_.bad_samples.fill_zero(queue_);
    counts_.resize(work_.counts.count());
}

void WaveStream::bind(const SceneBuffers& scene, const Buffer<float>& film,
                      const RenderParams& params) {
    for (std::size_t stage = 0; stage < stage_count; stage++) {
        bool writes_film = static_cast<Stage>(stage) == Stage::accumulate;
        const Buffer<float>& of_stage = writes_film ? film : no_film_;
        bind_arguments(kernels_[stage], scene, work_, of_stage, params);
        if (checked_) {
            kernels_[stage].setArg(sizes_argument, buffer_sizes(scene, work_, of_stage));
            kernels_[stage].setArg(outside_argument, outside_.handle());
        }
        kernels_[stage].setArg(depth_argument, 0);
    }
}

void WaveStream::set_wave(const WaveParams& wave) {
    for (cl::Kernel& kernel : kernels_)
        kernel.setArg(wave_argument, wave);
}

void WaveStream::launch(Stage stage, int depth, int work_items) {
    auto i = static_cast<std::size_t>(stage);
    kernels_[i].setArg(depth_argument, depth);
    std::size_t global = rounded_up(work_items, work_group_size_);
    cl::Event event;
    queue_.enqueueNDRangeKernel(kernels_[i], cl::NullRange, cl::NDRange(global),
                                cl::NDRange(work_group_size_), nullptr, &event);
    pending_.emplace_back(i, event);
}

std::pair<std::size_t, std::size_t> WaveStream::read_counts() {
    work_.counts.read(queue_, counts_.data());
    std::pair<std::size_t, std::size_t> sum{0, 0};
    for (std::size_t i = 0; i < counts_.size(); i += 2) {
        sum.first += counts_[i];
        sum.second += counts_[i + 1];
    }
    return sum;
}

std::array<std::uint64_t, statistic_count> WaveStream::read_statistics() {
    std::vector<ulong> values(work_.statistics.count());
    work_.statistics.read(queue_, values.data());
    std::array<std::uint64_t, statistic_count> sums{};
    for (std::size_t i = 0; i < values.size(); i++)
        sums[i % statistic_count] += values[i];
    return sums;
}

std::vector<int> WaveStream::read_bad_samples() {
    std::vector<int> words(work_.bad_samples.count());
    work_.bad_samples.read(queue_, words.data());
    return words;
}

const char* WaveStream::read_outside() {
    cl_uint number = 0;
    outside_.read(queue_, &number);
    return number > 0 ? buffer_names[number - 1] : nullptr;
}

void WaveStream::collect_times() {
    queue_.finish();
    for (const auto& [stage, event] : pending_) {
        cl_ulong begin = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        cl_ulong end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        times_[stage].kernel_seconds += 1e-9 * static_cast<double>(end - begin);
        times_[stage].launches++;
    }
    pending_.clear();
}

} // namespace parhelion
