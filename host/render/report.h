// What a render did and what it cost, for people and for scripts.
#pragma once

#include "host/film/film_state.h"
#include "host/flatten/scene_frame.h"
#include "host/image/misfits.h"
#include "host/waves/stage_report.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace parhelion {

/// A kind of fault that samples were left out for.
struct FaultCount {
    std::string stage, fault; ///< e.g. "shade", "next_event"
    std::uint64_t samples = 0;
};

struct RenderReport {
    std::string scene_file, device, driver;
    std::vector<std::string> notes; ///< of the scene
    bool lenient = false;           ///< whether it was read leniently
    int lanes = 1, tracing_lanes = 1, width = 0, height = 0, samples_per_pixel = 0;
    std::uint32_t seed = 0;
    int replicates = 1;
    std::string sampler; ///< pattern of the samples: "faure" or "independent"
    SceneFrame frame;    ///< that the device sees the scene in
    double load_seconds = 0.0, bvh_seconds = 0.0, compile_seconds = 0.0, upload_seconds = 0.0,
           render_seconds = 0.0, write_seconds = 0.0;
    std::vector<StageReport> stages;
    std::uint64_t paths = 0, camera_rays = 0, bounce_rays = 0, shadow_rays = 0,
                  non_finite_samples = 0;
    std::uint64_t taken_up_paths = 0, taken_up_rays = 0; ///< of those, by renders before this one
    std::vector<FaultCount> faults;     ///< of those samples; kinds that there are none of left out
    std::vector<BadSample> bad_samples; ///< a few of them, in the order of samples and pixels
    std::vector<Misfits> misfits;       ///< values that the written file does not hold as they are
    std::uint64_t primitives = 0, lights = 0;
    std::uint64_t device_scene_bytes = 0, device_pool_bytes = 0, device_film_bytes = 0,
                  film_scratch_bytes = 0, ///< of a film on the disk; 0: it is in memory
        host_peak_bytes = 0,
                  compiler_peak_bytes = 0; ///< of a second process that compiled kernels; 0: none
    std::vector<std::string> features, skipped_features;
    std::map<std::string, std::string> feature_reasons; ///< what was found that decides each

    std::uint64_t rays() const { return camera_rays + bounce_rays + shadow_rays; }
    bool all_cached() const;
};

/// What was counted, into a report that has nothing of it.
void add_state(const FilmState& state, RenderReport& report);

/// One object; every key that has a unit ends in it.
nlohmann::json to_json(const RenderReport& report);

/// JSON has no infinities: "inf", "-inf" and "nan" stand for what is no finite number.
nlohmann::json json_number(double value);

/// Centre (scene's units), unit (scene's units, a power of two), where camera rays start along the
/// axis (scene's units) and the unit of radiance.
nlohmann::json to_json(const SceneFrame& frame);

} // namespace parhelion
