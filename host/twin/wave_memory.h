// What kernels on the host read and write: the scene's arrays, and the work buffers with floats or
// doubles in them.
#pragma once

#include "host/flatten/scene_arrays.h"
#include "host/waves/stages.h"
#include "host/waves/wave.h"
#include "host/waves/work_sizes.h"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace parhelion {

/// The type of a work buffer's elements where the kernels count in Reals; an int among Reals takes
/// the first bytes of one.
template<class Real, class T>
using WorkElement = std::conditional_t<std::is_same_v<T, float>, Real, T>;

#define WORK_RESIZE(type, name) name.resize(sizes_of.name);
#define WORK_MEMBER(type, name) std::vector<WorkElement<Real, type>> name;
template<class Real>
struct WaveMemory {
    WORK_BUFFERS(WORK_MEMBER)

    /// All zero.
    explicit WaveMemory(const WorkSizes& sizes) {
        BufferCounts sizes_of = buffer_counts(sizes);
        WORK_BUFFERS(WORK_RESIZE)
    }
};
#undef WORK_MEMBER
#undef WORK_RESIZE

/// A launch of one work-item of a stage needs all of this.
template<class Real>
struct HostLaunch {
    SceneArrays scene;
    RenderParams params;
    FeatureSet features; ///< of the kernels
    WaveParams wave;
    WaveMemory<Real>& memory;
};

/// The launches that follow are of this wave; the film is in one band.
template<class Real>
void set_wave(HostLaunch<Real>& launch, const Wave& wave) {
    const std::vector<WaveBlock> blocks = wave_blocks(wave);
    std::copy(blocks.begin(), blocks.end(), launch.memory.wave_blocks.begin());
    launch.wave = wave_params(wave, 0);
}

/// Runs one work-item of a stage.
void run_work_item(Stage stage, const HostLaunch<float>& launch, int depth, int number);
/// In double precision.
void run_work_item(Stage stage, const HostLaunch<double>& launch, int depth, int number);

} // namespace parhelion
