// `parhelion info --estimate`: how long a render will take and how much memory, found by beginning
// it.
#include "host/commands/estimate_info.h"

#include "host/commands/render_device_options.h"
#include "host/commands/render_key.h"
#include "host/commands/render_outputs.h"
#include "host/film/film_image.h"
#include "host/memory_use.h"
#include "host/render/estimate.h"
#include "host/render/memory_plan.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace parhelion {
namespace {

constexpr double measured_seconds = 2;

/// Of the values alone, without a header.
std::uint64_t picture_bytes(const RenderCommand& command, const FilmContent& content) {
    const ExrOptions form = exr_options(command.form, content);
    const AddedFilms nothing({});
    const FilmPicture picture(nothing, content);
    std::uint64_t bytes = 0;
    for (const Channel& channel : picture.frame().channels)
        bytes += form.component_of(channel.name) == ComponentFormat::float16 ? 2 : 4;
    return bytes * picture.frame().pixel_count();
}

nlohmann::json time_json(const RenderReport& r, const RenderEstimate& e) {
    return {{"load_seconds", r.load_seconds},
            {"bvh_seconds", r.bvh_seconds},
            {"compile_seconds", r.compile_seconds},
            {"compile_cached", r.all_cached()},
            {"upload_seconds", r.upload_seconds},
            {"render_seconds", e.seconds},
            {"render_uncertainty", e.uncertainty ? nlohmann::json(*e.uncertainty) : nullptr},
            {"rendered_seconds", e.rendered_seconds},
            {"rendered_share", e.rendered_share}};
}

/// That a whole render stays below on the host, whose pool and film, if they are there, have been
/// allocated but not used: `begun` is what there is then. A checkpoint's copy comes to it.
std::uint64_t most_host_bytes(const RenderReport& r, std::uint64_t begun, bool of_host) {
    const std::uint64_t work = of_host ? r.device_pool_bytes + r.device_film_bytes : 0;
    return std::max(peak_host_bytes(), begun + work + passing_bytes);
}

nlohmann::json memory_json(const RenderReport& r, const RenderEstimate& e, std::uint64_t most) {
    return {{"host_peak_bytes", peak_host_bytes()},
            {"host_most_bytes", most},
            {"film_share", e.film_share},
            {"compiler_peak_bytes", r.compiler_peak_bytes},
            {"device_scene_bytes", r.device_scene_bytes},
            {"device_pool_bytes", r.device_pool_bytes},
            {"device_film_bytes", r.device_film_bytes}};
}

std::string seconds_text(double s) {
    if (s < 100) return fmt::format("{:.2f} s", s);
    return fmt::format("{:.0f} s ({})", s,
                       s < 7200 ? fmt::format("{:.0f} min", s / 60)
                                : fmt::format("{:.1f} h", s / 3600));
}

std::string megabytes(const nlohmann::json& bytes) {
    return fmt::format("{:.1f} MB", bytes.get<double>() / 1e6);
}

std::string before_text(const nlohmann::json& time) {
    const auto seconds = [&](const char* name) { return time[name].get<double>(); };
    return fmt::format("reading {:.2f} s, tree {:.2f} s, kernels {:.2f} s ({}), to the device "
                       "{:.2f} s",
                       seconds("load_seconds"), seconds("bvh_seconds"), seconds("compile_seconds"),
                       time["compile_cached"].get<bool>() ? "cached" : "compiled",
                       seconds("upload_seconds"));
}

/// How sure it is, and where it is from.
std::string rendering_text(const nlohmann::json& time) {
    const double share = time["rendered_share"].get<double>();
    std::string text = seconds_text(time["render_seconds"].get<double>());
    if (share == 1) return text + ", without writing: all of it was rendered";
    const nlohmann::json& uncertainty = time["render_uncertainty"];
    text += uncertainty.is_null() ? " roughly"
                                  : fmt::format(" +- {:.0f} % on a machine as busy as now",
                                                std::ceil(100 * uncertainty.get<double>()));
    return text + fmt::format(", without writing: from {:.2g} % of its samples, all over the film, "
                              "in {:.1f} s",
                              100 * share, time["rendered_seconds"].get<double>());
}

} // namespace

nlohmann::json estimate(const RenderCommand& command, const Scene& scene, double load_seconds,
                        Progress& progress) {
    RenderDevice& device = open_device_of(command);
    OpenedRender opened = open_on_device(scene, device, options_of(command), progress);
    const std::uint64_t begun = resident_host_bytes();
    opened.report.load_seconds = load_seconds;
    const FilmHeader header = header_of(command, scene, render_key(command, scene), opened);
    const nlohmann::json files{{"picture_bytes", picture_bytes(command, header.content)},
                               {"checkpoint_most_bytes", most_film_bytes(header)}};
    progress.start("rendering a little");
    const RenderEstimate found =
        estimate_render(*opened.engine, header.part, measured_seconds, progress);
    progress.finish("");
    opened.engine->report(opened.report);
    return {{"device", opened.report.device},
            {"part", header.part_name},
            {"time", time_json(opened.report, found)},
            {"memory", memory_json(opened.report, found,
                                   most_host_bytes(opened.report, begun, device.device.is_cpu))},
            {"files", files}};
}

void add_estimate(const nlohmann::json& estimate, InfoText& text) {
    const nlohmann::json &time = estimate["time"], &memory = estimate["memory"],
                         &files = estimate["files"];
    text.add("device", estimate["device"].get<std::string>());
    text.add("beforehand", before_text(time));
    const auto part = estimate["part"].get<std::string>();
    text.add("rendering", (part.empty() ? "" : "part " + part + ": ") + rendering_text(time));
    text.add("on device", fmt::format("{} for the scene, {} for paths in flight, up to {} for the "
                                      "film",
                                      megabytes(memory["device_scene_bytes"]),
                                      megabytes(memory["device_pool_bytes"]),
                                      megabytes(memory["device_film_bytes"])));
    text.add("on host", fmt::format("{} at most so far, with {:.0f} % of the film in use; a render "
                                    "stays below {}",
                                    megabytes(memory["host_peak_bytes"]),
                                    100 * memory["film_share"].get<double>(),
                                    megabytes(memory["host_most_bytes"])));
    text.add("files", fmt::format("{} for the picture, uncompressed; up to {} for a checkpoint",
                                  megabytes(files["picture_bytes"]),
                                  megabytes(files["checkpoint_most_bytes"])));
}

} // namespace parhelion
