// The kernels on the host as a device for waves.
#pragma once

#include "host/parallel.h"
#include "host/twin/wave_memory.h"

#include <span>

namespace parhelion {

/// A WaveDevice. Work-items of a stage run side by side: none reads what another writes.
template<class Real>
class TwinWaves {
public:
    /// What `launch` refers to must outlive it.
    explicit TwinWaves(const HostLaunch<Real>& launch) : launch_(launch) {}

    void begin_wave(const Wave& wave) { set_wave(launch_, wave); }
    void launch(Stage stage, int depth, int work_items) {
        parallel_for(static_cast<std::size_t>(work_items), [&](std::size_t number) {
            run_work_item(stage, launch_, depth, static_cast<int>(number));
        });
    }
    std::span<const int> read_counts() const { return launch_.memory.counts; }
    double end_wave() { return 0; }

private:
    HostLaunch<Real> launch_;
};

} // namespace parhelion
