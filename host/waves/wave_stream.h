// A pool of paths with a queue of its own: launches the stages of one wave after the other.
#pragma once

#include "host/cl/queue_end.h"
#include "host/waves/buffers.h"
#include "host/waves/stage_programs.h"
#include "host/waves/wave.h"

#include <array>
#include <span>
#include <vector>

namespace parhelion {

/// What a stage has taken so far.
struct StageTime {
    double kernel_seconds = 0, longest_seconds = 0; ///< of all launches, of one
    std::size_t launches = 0;
};

/// A WaveDevice. Streams of one render may be used by a thread each.
class WaveStream {
public:
    WaveStream(const RenderDevice& device, const StagePrograms& programs, const WorkSizes& sizes);

    /// Binds buffers and parameters to every kernel. `films`: bands of one size, of the sizes'
    /// layout, all or as many as are in memory at once; they must outlive the stream.
    void bind(const SceneBuffers& scene, const std::vector<Buffer<cl_uint>>& films,
              const RenderParams& params);

    void begin_wave(const Wave& wave);
    void launch(Stage stage, int depth, int work_items);
    /// Of all segments after the last launch; waits for it.
    std::span<const int> read_counts();
    /// Waits for the device, and adds what each stage took; the longest launch, seconds.
    double end_wave();
    /// Launches every stage without a path: a driver that looks for memory only then has found it,
    /// or says so, while nothing is on the film.
    void try_out();

    /// What the first `slots` of the pool have of a channel of results.
    std::vector<float> read_results(int channel, std::size_t slots);
    /// Of all segments.
    std::vector<ulong> read_statistics();
    /// BAD_SAMPLE_FIELDS a block of the film.
    std::vector<int> read_bad_samples();
    /// The name of a buffer that a checked kernel has left; null: none has.
    const char* read_outside();

    const std::array<StageTime, stage_count>& stage_times() const { return times_; }
    /// The same for any resolution, but for bad_sample_bytes.
    std::size_t pool_bytes() const { return work_.bytes() - bad_sample_bytes(); }
    std::size_t bad_sample_bytes() const { return work_.bad_samples.bytes(); }

private:
    /// Of those that have ended. Throws where one has failed.
    void look_at_launches();

    cl::CommandQueue queue_;
    std::vector<cl::Kernel> kernels_; // arguments belong to a kernel: one for each stream and Stage
    WaveBuffers work_;
    /// Bound where a stage leaves the film alone, or the driver would let streams wait for each
    /// other.
    Buffer<cl_uint> no_film_;
    std::vector<cl::Buffer> films_;
    WorkSizes sizes_;
    RenderParams params_{};
    std::vector<WaveBlock> blocks_; ///< of the wave
    Buffer<cl_uint> outside_;       ///< of checked kernels
    bool checked_;
    std::vector<std::pair<std::size_t, cl::Event>> pending_;
    std::array<StageTime, stage_count> times_{};
    double longest_ = 0; ///< of the wave's launches
    std::vector<int> counts_;
    QueueEnd end_; // before all of these
};

} // namespace parhelion
