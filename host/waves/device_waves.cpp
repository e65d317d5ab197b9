// The device side of a render: compiled stages, the scene's buffers, the film, and streams of
// waves.
#include "host/waves/device_waves.h"

namespace parhelion {

DeviceWaves::DeviceWaves(RenderDevice& device, const StageOptions& options)
    : device_(device), stages_(compile_stages(device, options)) {}

void DeviceWaves::upload(const DeviceScene& scene) {
    scene_ = scene_buffers(device_.context, device_.queue, scene_arrays(scene));
}

void DeviceWaves::allocate(const WorkSizes& s, const RenderParams& params) {
    for (int band = 0; band < s.bands_at_once; band++)
        films_.push_back(
            Buffer<cl_uint>::zeros(device_.context, device_.queue, "film", buffer_counts(s).film));
    for (int i = 0; i < s.streams; i++) {
        streams_.emplace_back(device_, stages_, s);
        streams_.back().bind(scene_, films_, params);
    }
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
