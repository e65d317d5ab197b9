// The device side of a render: compiled stages, the scene's buffers, the film, and streams of
// waves.
#include "host/waves/device_waves.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion {

DeviceWaves::DeviceWaves(RenderDevice& device, const StageOptions& options)
    : device_(device), stages_(compile_stages(device, options)) {}

void DeviceWaves::upload(const DeviceScene& scene) {
    scene_ = scene_buffers(device_.context, device_.queue, scene_arrays(scene));
}

void DeviceWaves::make_streams(const WorkSizes& s, const RenderParams& params) {
    streams_.clear();
    try {
        for (int i = 0; i < s.streams; i++) {
            streams_.emplace_back(device_, stages_, s);
            streams_.back().bind(scene_, films_, params);
        }
        for (WaveStream& stream : streams_)
            stream.try_out();
    } catch (const cl::Error& e) {
        if (!says_no_room(e.err())) throw;
        throw NoRoom(fmt::format("the device has no room for {} paths at once: {} in {}",
                                 s.streams * s.path_capacity, opencl_error_name(e.err()),
                                 e.what()));
    }
}

WorkSizes DeviceWaves::allocate(std::span<const WorkSizes> sizes,
                                const std::function<RenderParams(const WorkSizes&)>& params) {
    for (int band = 0; band < sizes.front().bands_at_once; band++)
        films_.push_back(Buffer<cl_uint>::zeros(device_.context, device_.queue, "film",
                                                buffer_counts(sizes.front()).film));
    for (const WorkSizes& s : sizes.first(sizes.size() - 1)) {
        try {
            make_streams(s, params(s));
            return s;
        } catch (const NoRoom&) {
            streams_.clear();
        }
    }
    make_streams(sizes.back(), params(sizes.back()));
    return sizes.back();
}

std::vector<ulong> DeviceWaves::read_statistics() {
    std::vector<ulong> all;
    for (WaveStream& stream : streams_) {
        std::vector<ulong> of_stream = stream.read_statistics();
        all.insert(all.end(), of_stream.begin(), of_stream.end());
    }
    return all;
}

std::vector<BadSample> DeviceWaves::read_bad_samples() {
    std::vector<std::vector<int>> of_streams;
    for (WaveStream& stream : streams_)
        of_streams.push_back(stream.read_bad_samples());
    return first_bad_samples(of_streams);
}

std::vector<StageReport> DeviceWaves::stage_reports() const {
    std::vector<StageReport> reports = stages_.reports;
    for (const WaveStream& stream : streams_)
        for (std::size_t i = 0; i < stage_count; i++) {
            const StageTime& time = stream.stage_times()[i];
            reports[i].kernel_seconds += time.kernel_seconds;
            reports[i].longest_launch_seconds =
                std::max(reports[i].longest_launch_seconds, time.longest_seconds);
            reports[i].launches += time.launches;
        }
    return reports;
}

std::size_t DeviceWaves::film_bytes() const {
    std::size_t bytes = 0;
    for (const Buffer<cl_uint>& film : films_)
        bytes += film.bytes();
    for (const WaveStream& stream : streams_)
        bytes += stream.bad_sample_bytes();
    return bytes;
}

std::size_t DeviceWaves::pool_bytes() const {
    std::size_t bytes = 0;
    for (const WaveStream& stream : streams_)
        bytes += stream.pool_bytes();
    return bytes;
}

} // namespace parhelion
