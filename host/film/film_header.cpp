// What a film's file begins with, as JSON.
#include "host/film/film_header.h"

#include "host/error.h"
#include "host/film/whole_number.h"

#include <nlohmann/json.hpp>

namespace parhelion {
namespace {

nlohmann::json to_json(const SampleRange& r) {
    return {r.first_block, r.end_block, r.first, r.end};
}

nlohmann::json to_json(const BadSample& b) { return {b.x, b.y, b.sample, b.fault, b.bounce}; }

template<class T>
nlohmann::json list(const std::vector<T>& values) {
    nlohmann::json json = nlohmann::json::array();
    for (const T& value : values)
        json.push_back(to_json(value));
    return json;
}

nlohmann::json to_json(const FilmState& state) {
    return {{"samples", list(state.samples)},
            {"counts", state.counts},
            {"bad_samples", list(state.bad_samples)}};
}

void require(bool holds, const char* what) {
    if (!holds) throw InputError(what);
}

/// Every range is one of samples that there are, and none is in two of them.
SampleSet samples_of(const nlohmann::json& json, const SampleSet& all) {
    SampleSet samples;
    for (const nlohmann::json& r : json) {
        samples.push_back({whole_number(r.at(0)), whole_number(r.at(1)), whole_number(r.at(2)),
                           whole_number(r.at(3))});
        const SampleRange& range = samples.back();
        require(range.first_block < range.end_block && range.first < range.end,
                "a range of samples is empty");
    }
    require((samples | samples) == samples && (samples - all).empty(),
            "its samples are none of its render");
    return samples;
}

FilmState state_of(const nlohmann::json& json, const SampleSet& all) {
    FilmState state;
    state.samples = samples_of(json.at("samples"), all);
    for (std::size_t i = 0; i < state.counts.size(); i++) {
        const nlohmann::json& count = json.at("counts").at(i);
        require(count.is_number_unsigned(), "a count is none");
        state.counts[i] = count.get<std::uint64_t>();
    }
    for (const nlohmann::json& b : json.at("bad_samples")) {
        state.bad_samples.push_back({whole_number(b.at(0)), whole_number(b.at(1)),
                                     whole_number(b.at(2)), whole_number(b.at(3)),
                                     whole_number(b.at(4))});
        const int fault = state.bad_samples.back().fault;
        require(fault >= 0 && fault < fault_count, "there is no such fault");
    }
    return state;
}

/// Name and value each.
nlohmann::json metadata_json(const std::vector<std::pair<std::string, MetadataValue>>& metadata) {
    nlohmann::json json = nlohmann::json::array();
    for (const auto& [name, value] : metadata)
        json.push_back({name, std::visit([](const auto& v) { return nlohmann::json(v); }, value)});
    return json;
}

MetadataValue metadata_value(const nlohmann::json& json) {
    if (json.is_string()) return json.get<std::string>();
    if (json.is_number_integer()) return json.get<std::int64_t>();
    return json.get<double>();
}

} // namespace

nlohmann::json to_json(const FilmHeader& h) {
    return {{"key", h.key},
            {"content", to_json(h.content)},
            {"blocks", h.blocks},
            {"samples_per_pixel", h.samples_per_pixel},
            {"part_name", h.part_name},
            {"part", list(h.part)},
            {"state", to_json(h.state)},
            {"metadata", metadata_json(h.metadata)}};
}

FilmHeader film_header(const nlohmann::json& json) {
    FilmHeader h;
    h.key = json.at("key").get<RenderKey>();
    h.content = film_content(json.at("content"));
    h.blocks = whole_number(json.at("blocks"));
    h.samples_per_pixel = whole_number(json.at("samples_per_pixel"));
    require(h.blocks > 0 && h.samples_per_pixel > 0, "it is of no samples");
    h.part_name = json.at("part_name");
    h.part = samples_of(json.at("part"), h.all());
    h.state = state_of(json.at("state"), h.all());
    for (const nlohmann::json& entry : json.at("metadata"))
        h.metadata.emplace_back(entry.at(0), metadata_value(entry.at(1)));
    return h;
}

} // namespace parhelion
