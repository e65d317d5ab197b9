// What a render did and what it cost, for people and for scripts.
#include "host/render/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace parhelion {
namespace {

nlohmann::json to_json(const StageReport& s) {
    return {{"name", s.name},
            {"kernel_seconds", s.kernel_seconds},
            {"longest_launch_seconds", s.longest_launch_seconds},
            {"launches", s.launches},
            {"compile_seconds", s.compile_seconds},
            {"cached", s.cached},
            {"features", s.features}};
}

nlohmann::json to_json(const FaultCount& f) {
    return {{"stage", f.stage}, {"fault", f.fault}, {"samples", f.samples}};
}

nlohmann::json to_json(const BadSample& b) {
    nlohmann::json json{{"pixel_x", b.x},
                        {"pixel_y", b.y},
                        {"sample", b.sample},
                        {"stage", b.stage()},
                        {"fault", b.fault_name()}};
    if (b.bounce >= 0) json["bounce"] = b.bounce;
    return json;
}

nlohmann::json to_json(const Misfits& m) {
    return {{"channel", m.channel},
            {"not_finite", m.not_finite},
            {"out_of_range", m.out_of_range},
            {"first", {{"pixel_x", m.x}, {"pixel_y", m.y}, {"value", json_number(m.value)}}}};
}

template<class T>
nlohmann::json list(const std::vector<T>& values) {
    nlohmann::json json = nlohmann::json::array();
    for (const T& value : values)
        json.push_back(to_json(value));
    return json;
}

double rate(std::uint64_t count, double seconds) {
    return seconds > 0.0 ? static_cast<double>(count) / seconds : 0.0;
}

} // namespace

bool RenderReport::all_cached() const {
    return std::all_of(stages.begin(), stages.end(), [](const StageReport& s) { return s.cached; });
}

nlohmann::json json_number(double value) {
    if (std::isfinite(value)) return value;
    return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

void add_state(const FilmState& state, RenderReport& report) {
    report.camera_rays = report.paths = state.counts[statistic_camera_rays];
    report.bounce_rays = state.counts[statistic_bounce_rays];
    report.shadow_rays = state.counts[statistic_shadow_rays];
    report.non_finite_samples = non_finite_samples(state.counts);
    report.bad_samples = state.bad_samples;
    for (int fault = 0; fault < fault_count; fault++)
        if (const std::uint64_t samples = state.counts[statistic_first_fault + fault])
            report.faults.push_back({fault_stages[fault], fault_names[fault], samples});
}

nlohmann::json to_json(const SceneFrame& frame) {
    glm::dvec3 centre = frame.centre();
    return {{"centre", {centre.x, centre.y, centre.z}},
            {"unit", frame.unit()},
            {"unit_exponent", frame.unit_exponent()},
            {"rays_start", frame.start},
            {"radiance_unit", frame.radiance_unit}};
}

nlohmann::json to_json(const RenderReport& r) {
    return {{"scene", r.scene_file},
            {"notes", r.notes},
            {"lenient", r.lenient},
            {"device",
             {{"name", r.device},
              {"driver", r.driver},
              {"lanes", r.lanes},
              {"tracing_lanes", r.tracing_lanes}}},
            {"image",
             {{"width_pixels", r.width},
              {"height_pixels", r.height},
              {"samples_per_pixel", r.samples_per_pixel},
              {"seed", r.seed},
              {"sampler", r.sampler},
              {"replicates", r.replicates}}},
            {"time",
             {{"load_seconds", r.load_seconds},
              {"bvh_seconds", r.bvh_seconds},
              {"compile_seconds", r.compile_seconds},
              {"compile_cached", r.all_cached()},
              {"upload_seconds", r.upload_seconds},
              {"render_seconds", r.render_seconds},
              {"write_seconds", r.write_seconds}}},
            {"frame", to_json(r.frame)},
            {"stages", list(r.stages)},
            {"faults", list(r.faults)},
            {"bad_samples", list(r.bad_samples)},
            {"misfits", list(r.misfits)},
            {"counts",
             {{"paths", r.paths},
              {"camera_rays", r.camera_rays},
              {"bounce_rays", r.bounce_rays},
              {"shadow_rays", r.shadow_rays},
              {"taken_up_paths", r.taken_up_paths},
              {"taken_up_rays", r.taken_up_rays},
              {"non_finite_samples", r.non_finite_samples},
              {"misfits", misfit_count(r.misfits)},
              {"primitives", r.primitives},
              {"lights", r.lights}}},
            {"rates",
             {{"paths_per_second", rate(r.paths - r.taken_up_paths, r.render_seconds)},
              {"rays_per_second", rate(r.rays() - r.taken_up_rays, r.render_seconds)}}},
            {"memory",
             {{"device_scene_bytes", r.device_scene_bytes},
              {"device_pool_bytes", r.device_pool_bytes},
              {"device_film_bytes", r.device_film_bytes},
              {"film_scratch_bytes", r.film_scratch_bytes},
              {"host_peak_bytes", r.host_peak_bytes},
              {"compiler_peak_bytes", r.compiler_peak_bytes}}},
            {"features", r.features},
            {"skipped_features", r.skipped_features},
            {"feature_reasons", r.feature_reasons}};
}

} // namespace parhelion
