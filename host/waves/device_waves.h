// The device side of a render: compiled stages, the scene's buffers, the film, and streams of
// waves.
#pragma once

#include "host/film/bad_samples.h"
#include "host/waves/wave_stream.h"

#include <deque>
#include <functional>
#include <span>

namespace parhelion {

class DeviceWaves {
public:
    /// `device` must outlive it.
    DeviceWaves(RenderDevice& device, const StageOptions& options);

    /// `scene` must outlive the waves and not change: a CPU reads its large arrays where they
    /// are.
    void upload(const DeviceScene& scene);
    /// Film and streams, bound to the scene and the parameters of those sizes: of `sizes`, larger
    /// ones first, the first that the device has room for, which is returned. Throws NoRoom.
    WorkSizes allocate(std::span<const WorkSizes> sizes,
                       const std::function<RenderParams(const WorkSizes&)>& params);

    std::vector<WaveStream>& streams() { return streams_; }
    /// Of each band of the film.
    template<class Word>
    std::deque<BufferView<Word>> film_views() const {
        std::deque<BufferView<Word>> views;
        for (const Buffer<cl_uint>& film : films_)
            views.emplace_back(device_.queue, film);
        return views;
    }
    /// While nothing is traced.
    void clear_films() const {
        for (const Buffer<cl_uint>& film : films_)
            film.zero_again(device_.queue);
    }
    /// STATISTICS and FAULTS of each segment of all streams.
    std::vector<ulong> read_statistics();
    /// The first ones of all, as first_bad_samples has them.
    std::vector<BadSample> read_bad_samples();
    std::vector<StageReport> stage_reports() const;
    /// Of the process that compiled beside this one, bytes; 0: there was none.
    std::uint64_t compiler_peak_bytes() const { return stages_.beside_peak_bytes; }
    const std::vector<std::string>& notes() const { return stages_.notes; }
    /// Of the streams there are.
    std::size_t pool_bytes() const;
    std::size_t film_bytes() const;

private:
    void make_streams(const WorkSizes& sizes, const RenderParams& params);

    RenderDevice& device_;
    StagePrograms stages_;
    SceneBuffers scene_;
    std::vector<Buffer<cl_uint>> films_;
    std::vector<WaveStream> streams_;
};

} // namespace parhelion
