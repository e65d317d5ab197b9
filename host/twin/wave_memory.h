// What kernels on the host read and write: the scene's arrays, and the work buffers with floats or
// doubles in them.
#pragma once

#include "host/flatten/scene_arrays.h"
#include "host/waves/stages.h"
#include "host/waves/wave_stream.h"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace parhelion {

/// The type of a work buffer's elements where the kernels count in Reals; an int among Reals takes
/// the first bytes of one.
template<class Real, class T>
using WorkElement = std::conditional_t<std::is_same_v<T, float>, Real, T>;

#define WORK_MEMBER(type, name) std::vector<WorkElement<Real, type>> name;
template<class Real>
struct WaveMemory {
    WORK_BUFFERS(WORK_MEMBER)

    /// All zero.
    explicit WaveMemory(const WorkSizes& s)
        : path_state(path_word_count * s.state_stride()),
          shadow_state(shadow_word_count * s.state_stride()),
          results(s.film.result_channels() * s.result_stride()),
          counts(2 * static_cast<std::size_t>(s.segments)),
          statistics(statistic_count *
                     static_cast<std::size_t>(std::max(s.segments, s.blocks_per_wave))),
          bad_samples(s.bad_sample_words()), film(s.film.floats()) {}
};
#undef WORK_MEMBER

/// A launch of one work-item of a stage needs all of this.
template<class Real>
struct HostLaunch {
    SceneArrays scene;
    RenderParams params;
    FeatureSet features; ///< of the kernels
    WaveParams wave;
    WaveMemory<Real>& memory;
};

/// Runs one work-item of a stage.
void run_work_item(Stage stage, const HostLaunch<float>& launch, int depth, int number);
/// In double precision.
void run_work_item(Stage stage, const HostLaunch<double>& launch, int depth, int number);

} // namespace parhelion
