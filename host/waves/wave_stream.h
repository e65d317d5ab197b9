// A pool of paths with a queue of its own: launches the stages of one wave after the other.
#pragma once

#include "host/cl/buffer.h"
#include "host/film/film_layout.h"
#include "host/flatten/scene_arrays.h"
#include "host/waves/stage_programs.h"

#include <sys/types.h> // ulong, as the kernels call it

#include <array>
#include <vector>

namespace parhelion {

/// How work is split. None of these changes a bit of the image.
struct WorkSplit {
    int pool_paths = 1 << 16; ///< paths in flight: the memory of a render, whatever its resolution
    int segment_paths = 2048; ///< paths one work-item owns; made a multiple of 16
    int work_group_size = 1;
    int streams = 0; ///< waves under way at once, which share the pool; 0: what suits the device
};

#define BUFFER_MEMBER(type, name) Buffer<type> name;
struct SceneBuffers {
    SCENE_BUFFERS(BUFFER_MEMBER)
};
struct WaveBuffers {
    WAVE_BUFFERS(BUFFER_MEMBER)
    std::size_t bytes() const;
};

/// Sizes that follow from film, samples and split, of one stream.
struct WorkSizes {
    int streams = 1;
    int samples_per_wave = 1, blocks_per_wave = 1, path_capacity = 16;
    int segments = 1, segment_size = 16, segment_stride = 32;
    int work_group_size = 1;
    FilmLayout film;

    std::size_t bad_sample_words() const { return bad_sample_field_count * film.window.tiles(); }
    std::size_t result_stride() const { return odd_lines(path_capacity); }
    std::size_t state_stride() const {
        return odd_lines(static_cast<std::size_t>(segments) * segment_stride);
    }
};

/// `split.streams` must be chosen.
WorkSizes work_sizes(const FilmLayout& film, int samples, int lanes, const WorkSplit& split);

/// Binds buffers and parameters, all but the wave and the depth.
void bind_arguments(cl::Kernel& kernel, const SceneBuffers& scene, const WaveBuffers& work,
                    const Buffer<float>& film, const RenderParams& params);

/// What a stage has taken so far.
struct StageTime {
    double kernel_seconds = 0;
    std::size_t launches = 0;
};

/// Streams of one render may be used by a thread each.
class WaveStream {
public:
    WaveStream(const RenderDevice& device, const StagePrograms& programs, const WorkSizes& sizes);

    /// Binds buffers and parameters to every kernel.
    void bind(const SceneBuffers& scene, const Buffer<float>& film, const RenderParams& params);

    void set_wave(const WaveParams& wave);
    void launch(Stage stage, int depth, int work_items);
    /// Live paths and shadow rays of all segments after the last launch; waits for it.
    std::pair<std::size_t, std::size_t> read_counts();
    std::array<std::uint64_t, statistic_count> read_statistics();
    /// BAD_SAMPLE_FIELDS a block of the film.
    std::vector<int> read_bad_samples();
    /// The name of a buffer that a checked kernel has left; null: none has.
    const char* read_outside();
    /// Adds what each stage took since the last call; waits for the device.
    void collect_times();

    const std::array<StageTime, stage_count>& stage_times() const { return times_; }
    /// The same for any resolution, but for bad_sample_bytes.
    std::size_t pool_bytes() const { return work_.bytes() - bad_sample_bytes(); }
    std::size_t bad_sample_bytes() const { return work_.bad_samples.bytes(); }

private:
    cl::CommandQueue queue_;
    std::vector<cl::Kernel> kernels_; // arguments belong to a kernel: one for each stream and Stage
    WaveBuffers work_;
    /// Bound where a stage leaves the film alone, or the driver would let streams wait for each
    /// other.
    Buffer<float> no_film_;
    Buffer<cl_uint> outside_; ///< of checked kernels
    bool checked_;
    int work_group_size_;
    std::vector<std::pair<std::size_t, cl::Event>> pending_;
    std::array<StageTime, stage_count> times_{};
    std::vector<int> counts_;
};

} // namespace parhelion
