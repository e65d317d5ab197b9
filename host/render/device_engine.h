// A device that traces the waves of a render.
#pragma once

#include "host/film/coverage_tiles.h"
#include "host/film/film_store.h"
#include "host/render/engine.h"
#include "host/waves/device_waves.h"
#include "host/waves/render_device.h"
#include "host/waves/wavefront.h"

#include <optional>
#include <string>

namespace parhelion {

class DeviceEngine : public Engine {
public:
    /// `device` must outlive it.
    DeviceEngine(RenderDevice& device, DeviceScene scene, DeviceWaves waves);
    DeviceEngine(const DeviceEngine&) = delete;
    DeviceEngine& operator=(const DeviceEngine&) = delete;
    ~DeviceEngine() override;

    /// Film and streams, of the first of the sizes (of one film) that there is room for, which is
    /// returned. `scratch`: the folder for a film that is not in memory as a whole. Throws
    /// OutputError where it has no room for that.
    WorkSizes allocate(const Scene& scene, const AovPlan& aovs, bool checked,
                       const std::string& scratch, std::span<const WorkSizes> sizes);

    void trace(WaveSchedule& schedule, const std::function<void()>& on_wave) override;
    WaveLimits wave_limits() const override { return sizes_.wave_limits(); }
    int blocks_at_once() const override;
    void turn_to(int first_block) override;

    std::unique_ptr<FilmSums> film() override;
    void fill_film(const FilmSums& sums) override;

    TraceCounts counts() override;
    std::vector<BadSample> bad_samples() override { return waves_.read_bad_samples(); }
    void report(RenderReport& report) override;

private:
    std::unique_ptr<FilmSums> film_in_memory();
    void gather_hits(WaveStream& stream, const Wave& wave);
    void check_bounds();

    RenderDevice& device_;
    DeviceScene scene_;
    DeviceWaves waves_; // reads the scene where it is
    WorkSizes sizes_;
    WaveLoop loop_{};
    Film crop_;
    std::optional<CoverageTiles> coverage_; // where it is asked for
    std::unique_ptr<FilmStore> store_;      ///< of bands that are not in memory; none where all are
    int band_ = 0;                          ///< that is in memory, where one is at a time
    bool checked_ = false;
};

} // namespace parhelion
