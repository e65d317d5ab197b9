// `parhelion info` of a film in a file: a checkpoint, or a part of a render.
#include "host/commands/film_info.h"

#include "host/commands/info_text.h"
#include "host/commands/picture_form.h"
#include "host/film/film_image.h"
#include "host/render/report.h"
#include "host/scene/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace parhelion {
namespace {

double share(const SampleSet& there, const SampleSet& of) {
    const auto all = static_cast<double>(sample_count(of));
    return all == 0 ? 1.0 : static_cast<double>(sample_count(there & of)) / all;
}

/// Of the samples that are there, how many each block of the part has at least.
int fewest_of_part(const SampleSet& there, const SampleSet& part) {
    int fewest = std::numeric_limits<int>::max();
    for (const SampleRange& range : part) {
        SampleSet of_range = there & SampleSet{{range.first_block, range.end_block, 0,
                                                std::numeric_limits<int>::max()}};
        for (SampleRange& r : of_range)
            r.first_block -= range.first_block, r.end_block -= range.first_block;
        fewest = std::min(fewest, fewest_samples(of_range, range.end_block - range.first_block));
    }
    return part.empty() ? 0 : fewest;
}

nlohmann::json samples_json(const FilmHeader& h) {
    const SampleSet& there = h.state.samples;
    return {{"share_of_part", share(there, h.part)},
            {"share_of_whole", share(there, h.all())},
            {"fewest_per_pixel", fewest_of_part(there, h.part)},
            {"finished", there == h.part}};
}

/// Layers with their components, in the order of the picture.
nlohmann::json layers_json(const FilmHeader& h) {
    nlohmann::json layers = nlohmann::json::array();
    const AddedFilms nothing({});
    const FilmPicture picture(nothing, h.content);
    for (const Channel& channel : picture.frame().channels) {
        const std::string layer = layer_of(channel.name);
        const std::string name = layer.empty() ? main_layer_name : layer;
        if (layers.empty() || layers.back()["name"] != name)
            layers.push_back({{"name", name}, {"components", nlohmann::json::array()}});
        layers.back()["components"].push_back(
            channel.name.substr(layer.empty() ? 0 : layer.size() + 1));
    }
    return layers;
}

nlohmann::json picture_json(const FilmHeader& h) {
    nlohmann::json json = film_size_json(h.content.film);
    json["layers"] = layers_json(h);
    return json;
}

nlohmann::json metadata_json(const FilmHeader& h) {
    nlohmann::json json = nlohmann::json::object();
    for (const auto& [name, value] : h.metadata)
        json[name] = std::visit([](const auto& v) { return nlohmann::json(v); }, value);
    return json;
}

nlohmann::json key_json(const RenderKey& key) {
    nlohmann::json json = nlohmann::json::array();
    for (const auto& [name, value] : key)
        json.push_back({{"name", name}, {"value", value}});
    return json;
}

nlohmann::json counts_json(const FilmState& state) {
    RenderReport report;
    add_state(state, report);
    nlohmann::json faults = nlohmann::json::array();
    for (const FaultCount& f : report.faults)
        faults.push_back({{"stage", f.stage}, {"fault", f.fault}, {"samples", f.samples}});
    return {{"paths", report.paths},
            {"rays", report.rays()},
            {"non_finite_samples", report.non_finite_samples},
            {"faults", faults}};
}

std::string layers_text(const nlohmann::json& layers) {
    std::vector<std::string> texts;
    texts.reserve(layers.size());
    for (const nlohmann::json& layer : layers)
        texts.push_back(
            fmt::format("{} ({})", layer["name"].get<std::string>(),
                        fmt::join(layer["components"].get<std::vector<std::string>>(), " ")));
    return fmt::format("{}", fmt::join(texts, ", "));
}

std::string part_text(const nlohmann::json& info) {
    if (info["part"].is_string()) return info["part"].get<std::string>();
    return info["of_whole"].get<bool>() ? "the whole render" : "several parts of a render";
}

/// No share that is not all is told as 100 %.
std::string percent(const nlohmann::json& share) {
    return fmt::format("{:.2f} %", std::min(100.0 * share.get<double>(),
                                            share.get<double>() < 1.0 ? 99.99 : 100.0));
}

std::string samples_text(const nlohmann::json& info) {
    const nlohmann::json& samples = info["samples"];
    const bool finished = samples["finished"].get<bool>();
    std::string text = finished ? "finished: all" : percent(samples["share_of_part"]);
    if (!info["of_whole"].get<bool>())
        text += fmt::format(" of the part, {} of the whole", percent(samples["share_of_whole"]));
    return text + fmt::format("; at least {} a pixel{}", samples["fewest_per_pixel"].get<int>(),
                              finished ? "" : "; not finished");
}

/// What of the key the command line has said.
std::string options_text(const nlohmann::json& key) {
    std::vector<std::string> options;
    for (const nlohmann::json& entry : key)
        if (const auto name = entry["name"].get<std::string>(); name.starts_with('-'))
            options.push_back(name + " " + entry["value"].get<std::string>());
    return options.empty() ? "those of the scene" : fmt::format("{}", fmt::join(options, ", "));
}

std::string counts_text(const nlohmann::json& counts) {
    std::string text = fmt::format(
        "{} paths, {} rays, {} samples that are not finite", counts["paths"].get<std::uint64_t>(),
        counts["rays"].get<std::uint64_t>(), counts["non_finite_samples"].get<std::uint64_t>());
    for (const nlohmann::json& f : counts["faults"])
        text += fmt::format("; {} of {} in {}", f["samples"].get<std::uint64_t>(),
                            f["fault"].get<std::string>(), f["stage"].get<std::string>());
    return text;
}

} // namespace

bool is_to_be_film(const std::string& file) { return is_film_file(file) || begins_as_film(file); }

nlohmann::json describe_film(const FilmFile& film) {
    const FilmHeader& h = film.header();
    const bool has_name = !h.part_name.empty();
    return {{"film", film.name()},
            {"bytes", film.bytes()},
            {"picture", picture_json(h)},
            {"samples_per_pixel", h.samples_per_pixel},
            {"part", has_name ? nlohmann::json(h.part_name) : nlohmann::json()},
            {"of_whole", h.part == h.all()},
            {"samples", samples_json(h)},
            {"key", key_json(h.key)},
            {"metadata", metadata_json(h)},
            {"counts", counts_json(h.state)}};
}

std::string film_text(const nlohmann::json& info) {
    InfoText text(info["film"].get<std::string>());
    const nlohmann::json& metadata = info["metadata"];
    const auto told = [&](const char* label, const char* name) {
        if (!metadata.contains(name)) return;
        const nlohmann::json& value = metadata[name];
        text.add(label, value.is_string() ? value.get<std::string>() : value.dump());
    };
    text.add("film", film_size_text(info["picture"], info["samples_per_pixel"].get<int>()));
    text.add("part", part_text(info));
    text.add("samples", samples_text(info));
    text.add("layers", layers_text(info["picture"]["layers"]));
    told("scene", "scene");
    told("seed", "seed");
    text.add("options", options_text(info["key"]));
    told("device", "device");
    told("program", "software");
    const std::string notes = metadata.contains("notes") && metadata["notes"].is_string()
                                  ? metadata["notes"].get<std::string>()
                                  : "";
    for (const std::string_view note : split(notes, "\n"))
        text.add("note", std::string(note));
    text.add("counts", counts_text(info["counts"]));
    text.add("size", fmt::format("{} bytes", info["bytes"].get<std::uint64_t>()));
    return text.text();
}

} // namespace parhelion
