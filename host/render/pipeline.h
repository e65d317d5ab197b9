// The device side of a render: context, queue, compiled stages, buffers; and launching a stage.
#pragma once

#include "host/cl/buffer.h"
#include "host/render/sample_window.h"
#include "host/render/stage_programs.h"

#include <sys/types.h> // ulong, as the kernels call it

#include <array>
#include <vector>

namespace parhelion {

/// How work is split. None of these changes a bit of the image.
struct WorkSplit {
    int pool_paths = 1 << 16; ///< paths in flight: the memory of a render, whatever its resolution
    int segment_paths = 2048; ///< paths one work-item owns; made a multiple of 16
    int work_group_size = 1;
};

#define SCENE_BUFFER_MEMBER(type, name) Buffer<type> name;
struct SceneBuffers {
    SCENE_BUFFERS(SCENE_BUFFER_MEMBER)
};
struct WorkBuffers {
    WORK_BUFFERS(SCENE_BUFFER_MEMBER)
    std::size_t bytes() const;
};

/// Floats from one field or channel to the next: arrays a power of two apart would share the same
/// few places of a cache.
constexpr std::size_t odd_lines(std::size_t floats) { return 16 * ((floats + 15) / 16 | 1); }

/// Sizes that follow from film, samples and split.
struct WorkSizes {
    int samples_per_wave = 1, blocks_per_wave = 1, path_capacity = 16;
    int segments = 1, segment_size = 16, segment_stride = 32;
    SampleWindow window;
    int film_channels = 5;

    std::size_t result_stride() const { return odd_lines(path_capacity); }
    std::size_t film_stride() const { return odd_lines(window.tiles() * window.tile_cells()); }
    std::size_t state_stride() const {
        return odd_lines(static_cast<std::size_t>(segments) * segment_stride);
    }
};

WorkSizes work_sizes(const SampleWindow& window, int samples, int lanes, int film_channels,
                     const WorkSplit& split);

/// Binds buffers and parameters, all but the wave and the depth.
void bind_arguments(cl::Kernel& kernel, const SceneBuffers& scene, const WorkBuffers& work,
                    const RenderParams& params);

class Pipeline {
public:
    /// `device` must outlive it.
    Pipeline(RenderDevice& device, const StageOptions& options);

    /// `scene` must outlive the pipeline and not change: a CPU reads its large arrays where they
    /// are.
    void upload(const DeviceScene& scene);
    void allocate(const WorkSizes& sizes);
    /// Binds buffers and parameters to every kernel.
    void bind(const RenderParams& params);

    void set_wave(const WaveParams& wave);
    void launch(Stage stage, int depth, int work_items, int work_group_size);
    /// Live paths and shadow rays of all segments after the last launch; waits for it.
    std::pair<std::size_t, std::size_t> read_counts();
    std::vector<float> read_film();
    std::array<std::uint64_t, statistic_count> read_statistics();
    /// Adds what each stage took since the last call; waits for the device.
    void collect_times();
    /// Keeps freshly compiled programs for the next run.
    void store_programs() const;

    const std::vector<StageReport>& stage_reports() const { return stages_.reports; }
    std::size_t pool_bytes() const;
    std::size_t film_bytes() const { return work_.film.bytes(); }

private:
    RenderDevice& device_;
    StagePrograms stages_;
    std::vector<std::pair<std::size_t, cl::Event>> pending_;
    SceneBuffers scene_;
    WorkBuffers work_;
    std::vector<int> counts_;
};

} // namespace parhelion
