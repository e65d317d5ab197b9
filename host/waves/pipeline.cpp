// The device side of a render: compiled stages, the scene's buffers, the film, and streams of
// waves.
#include "host/waves/pipeline.h"

#include "host/flatten/scene_arrays.h"

namespace parhelion {

Pipeline::Pipeline(RenderDevice& device, const StageOptions& options)
    : device_(device), stages_(compile_stages(device, options)) {}

void Pipeline::upload(const DeviceScene& scene) {
    SceneArrays arrays = scene_arrays(scene);
#define UPLOAD(type, name)                                                                         \
    scene_.name = Buffer<type>::of(device_.context, device_.queue, #name, arrays.name);
    SCENE_BUFFERS(UPLOAD)
}

void Pipeline::allocate(const WorkSizes& s, const RenderParams& params) {
    film_ = {device_.context, "film", s.film.floats()};
    film_.fill_zero(device_.queue);
    device_.queue.finish();
    for (int i = 0; i < s.streams; i++) {
        streams_.emplace_back(device_, stages_, s);
        streams_.back().bind(scene_, film_, params);
    }
}

std::vector<float> Pipeline::read_film() {
    std::vector<float> film(film_.count());
    film_.read(device_.queue, film.data());
    return film;
}

std::array<std::uint64_t, statistic_count> Pipeline::read_statistics() {
    std::array<std::uint64_t, statistic_count> sums{};
    for (WaveStream& stream : streams_) {
        auto counts = stream.read_statistics();
        for (std::size_t i = 0; i < sums.size(); i++)
            sums[i] += counts[i];
    }
    return sums;
}

std::vector<BadSample> Pipeline::read_bad_samples() {
    std::vector<std::vector<int>> of_streams;
    for (WaveStream& stream : streams_)
        of_streams.push_back(stream.read_bad_samples());
    return first_bad_samples(of_streams);
}

std::vector<StageReport> Pipeline::stage_reports() const {
    std::vector<StageReport> reports = stages_.reports;
    for (const WaveStream& stream : streams_)
        for (std::size_t i = 0; i < stage_count; i++) {
            reports[i].kernel_seconds += stream.stage_times()[i].kernel_seconds;
            reports[i].launches += stream.stage_times()[i].launches;
        }
    return reports;
}

std::size_t Pipeline::film_bytes() const {
    std::size_t bytes = film_.bytes();
    for (const WaveStream& stream : streams_)
        bytes += stream.bad_sample_bytes();
    return bytes;
}

std::size_t Pipeline::pool_bytes() const {
    std::size_t bytes = 0;
    for (const WaveStream& stream : streams_)
        bytes += stream.pool_bytes();
    return bytes;
}

} // namespace parhelion
