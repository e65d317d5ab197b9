// The device side of a render: compiled stages, the scene's buffers, the film, and streams of
// waves.
#pragma once

#include "host/film/bad_samples.h"
#include "host/waves/wave_stream.h"

namespace parhelion {

class DeviceWaves {
public:
    /// `device` must outlive it.
    DeviceWaves(RenderDevice& device, const StageOptions& options);

    /// `scene` must outlive the waves and not change: a CPU reads its large arrays where they
    /// are.
    void upload(const DeviceScene& scene);
    /// Film and streams, bound to the scene and the parameters; in the place of others, whose
    /// accounts are kept.
    void allocate(const WorkSizes& sizes, const RenderParams& params);

    std::vector<WaveStream>& streams() { return streams_; }
    BufferView<cl_uint> film_view() { return {device_.queue, film_}; }
    /// STATISTICS and FAULTS of each segment of all streams there have been.
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
    RenderDevice& device_;
    StagePrograms stages_;
    SceneBuffers scene_;
    /// Takes the accounts of the streams.
    void keep_accounts();

    Buffer<cl_uint> film_;
    std::vector<WaveStream> streams_;
    std::vector<ulong> statistics_; ///< of those that are gone, like the next two
    std::vector<BadSample> bad_samples_;
    std::array<StageTime, stage_count> times_{};
};

} // namespace parhelion
