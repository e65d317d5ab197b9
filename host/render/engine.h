// What traces the waves of a render: a device, or the host.
#pragma once

#include "host/film/film_content.h"
#include "host/film/film_state.h"
#include "host/film/film_sums.h"
#include "host/render/report.h"
#include "host/waves/wave_schedule.h"

#include <functional>
#include <memory>

namespace parhelion {

/// Scene, kernels and film of one render. All but trace() only while nothing is traced.
class Engine {
public:
    Engine() = default;
    virtual ~Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    /// Waves until there are none left; see trace_waves.
    virtual void trace(WaveSchedule& schedule, const std::function<void()>& on_wave) = 0;
    virtual WaveLimits wave_limits() const = 0;

    /// Of how many blocks, from a multiple of that number on, the film is in memory at once.
    virtual int blocks_at_once() const = 0;
    /// What is traced next is of the blocks from there on. What there is of others stays on the
    /// film. Throws OutputError where it has no room on the disk.
    virtual void turn_to(int first_block) = 0;

    /// As it is, for as long as it is looked at.
    virtual std::unique_ptr<FilmSums> film() = 0;
    /// In the place of nothing. Throws OutputError likewise.
    virtual void fill_film(const FilmSums& sums) = 0;

    virtual TraceCounts counts() = 0;
    virtual std::vector<BadSample> bad_samples() = 0;
    /// What there is to tell of the waves beside counts.
    virtual void report(RenderReport& report) = 0;
};

/// What a session needs to know of an engine and what it renders.
struct OpenedRender {
    std::unique_ptr<Engine> engine;
    FilmContent content;
    int blocks = 0, samples_per_pixel = 0;
    RenderReport report;
    std::string place{}; ///< for progress, where it is not a device
};

} // namespace parhelion
