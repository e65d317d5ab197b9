// A pool of paths with a queue of its own: launches the stages of one wave after the other.
#include "host/waves/wave_stream.h"

#include "host/waves/kernel_arguments.h"

#include <algorithm>
#include <utility>

namespace parhelion {

WaveStream::WaveStream(const RenderDevice& device, const StagePrograms& programs,
                       const WorkSizes& s)
    : queue_(device.context, device.device.handle, CL_QUEUE_PROFILING_ENABLE),
      no_film_(device.context, "film", 0), sizes_(s), outside_(device.context, "outside", 1),
      checked_(programs.checked), end_(queue_) {
    for (std::size_t stage = 0; stage < stage_count; stage++)
        kernels_.push_back(programs.programs[stage].kernel(stage_names[stage]));
    work_ = wave_buffers(device.context, queue_, buffer_counts(s));
    outside_.fill_zero(queue_);
    queue_.finish(); // what is under way must not outlive its buffers
    counts_.resize(work_.counts.count());
}

void WaveStream::bind(const SceneBuffers& scene, const std::vector<Buffer<cl_uint>>& films,
                      const RenderParams& params) {
    params_ = params;
    films_.clear();
    films_.reserve(films.size());
    for (const Buffer<cl_uint>& film : films)
        films_.push_back(film.handle());
    for (std::size_t stage = 0; stage < stage_count; stage++) {
        bool writes_film = static_cast<Stage>(stage) == Stage::accumulate;
        const Buffer<cl_uint>& of_stage = writes_film ? films.front() : no_film_;
        bind_arguments(kernels_[stage], scene, work_, of_stage, params);
        if (checked_) bind_bounds(kernels_[stage], scene, work_, of_stage, outside_);
        kernels_[stage].setArg(depth_argument, 0);
    }
}

void WaveStream::begin_wave(const Wave& wave) {
    blocks_ = wave_blocks(wave);
    queue_.enqueueWriteBuffer(work_.wave_blocks.handle(), CL_FALSE, 0,
                              blocks_.size() * sizeof(WaveBlock), blocks_.data());
    const WaveParams params = wave_params(wave, sizes_.film.band_blocks);
    for (cl::Kernel& kernel : kernels_)
        kernel.setArg(wave_argument, params);
    kernels_[static_cast<std::size_t>(Stage::accumulate)].setArg(
        film_argument, films_[static_cast<std::size_t>(wave.band) % films_.size()]);
    params_.segment_size =
        sizes_.used_segment_size(BLOCK_PIXELS * params.block_count * params.sample_count);
    kernels_[static_cast<std::size_t>(Stage::generate)].setArg(params_argument, params_);
}

void WaveStream::try_out() {
    for (cl::Kernel& kernel : kernels_)
        kernel.setArg(wave_argument, WaveParams{});
    for (std::size_t i = 0; i < stage_count; i++) {
        const auto stage = static_cast<Stage>(i);
        launch(stage, 0, stage == Stage::accumulate ? sizes_.block_capacity() : sizes_.segments);
    }
    end_wave();
    times_ = {};
}

void WaveStream::launch(Stage stage, int depth, int work_items) {
    auto i = static_cast<std::size_t>(stage);
    kernels_[i].setArg(depth_argument, depth);
    const int group = sizes_.work_group_size, groups = (work_items + group - 1) / group;
    std::size_t global = static_cast<std::size_t>(groups) * group;
    cl::Event event;
    queue_.enqueueNDRangeKernel(kernels_[i], cl::NullRange, cl::NDRange(global), cl::NDRange(group),
                                nullptr, &event);
    pending_.emplace_back(i, event);
}

std::span<const int> WaveStream::read_counts() {
    work_.counts.read(queue_, counts_.data());
    look_at_launches(); // counts mean nothing where the device is lost: a path would never end
    return counts_;
}

std::vector<float> WaveStream::read_results(int channel, std::size_t slots) {
    std::vector<float> values(slots);
    work_.results.read(queue_, static_cast<std::size_t>(channel) * sizes_.result_stride(), slots,
                       values.data());
    return values;
}

std::vector<ulong> WaveStream::read_statistics() {
    std::vector<ulong> values(work_.statistics.count());
    work_.statistics.read(queue_, values.data());
    return values;
}

std::vector<int> WaveStream::read_bad_samples() {
    std::vector<int> words(work_.bad_samples.count());
    work_.bad_samples.read(queue_, words.data());
    return words;
}

const char* WaveStream::read_outside() {
    cl_uint number = 0;
    outside_.read(queue_, &number);
    return buffer_left(number);
}

void WaveStream::look_at_launches() {
    for (const auto& [stage, event] : pending_) {
        // Of a kernel that has failed not every driver tells when it is waited for.
        if (const cl_int status = event.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>(); status < 0)
            throw cl::Error(status, stage_names[stage]);
        cl_ulong begin = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        cl_ulong end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        const double seconds = 1e-9 * static_cast<double>(end - begin);
        times_[stage].kernel_seconds += seconds;
        times_[stage].longest_seconds = std::max(times_[stage].longest_seconds, seconds);
        times_[stage].launches++;
        longest_ = std::max(longest_, seconds);
    }
    pending_.clear();
}

double WaveStream::end_wave() {
    queue_.finish();
    look_at_launches();
    return std::exchange(longest_, 0);
}

} // namespace parhelion
