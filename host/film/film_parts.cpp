// Films that are to be added up.
#include "host/film/film_parts.h"

#include "host/error.h"
#include "host/film/film_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <set>

namespace parhelion {
namespace {

/// What two films have to have in common, beside their keys.
nlohmann::json common(const FilmHeader& header) {
    return {to_json(header.content), header.blocks, header.samples_per_pixel};
}

void check_same(const FilmFile& a, const FilmFile& b) {
    if (const std::string what = key_difference(a.header().key, b.header().key); !what.empty())
        throw InputError(
            fmt::format("{}: is not of the render of {}: {}", b.name(), a.name(), what));
    if (a.header().samples_per_pixel != b.header().samples_per_pixel)
        throw InputError(fmt::format("{}: is of {} samples a pixel, {} of {} (--spp)", b.name(),
                                     b.header().samples_per_pixel, a.name(),
                                     a.header().samples_per_pixel));
    if (common(a.header()) != common(b.header()))
        throw InputError(fmt::format("{}: is of another picture than {}", b.name(), a.name()));
}

/// K of the name "K/N by ..." and the rest of it, from the slash on; 0 where it has another form.
std::pair<int, std::string> numbered(const std::string& name) {
    int number = 0;
    const char* end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data(), end, number);
    const bool known = error == std::errc() && rest != end && *rest == '/';
    return {known ? number : 0, std::string(rest, end)};
}

/// The names of parts that are not there, where those that are have been numbered alike.
std::vector<std::string> missing_names(const std::deque<FilmFile>& parts) {
    std::set<int> there;
    std::string of;
    for (const FilmFile& part : parts) {
        const auto [number, rest] = numbered(part.header().part_name);
        if (number == 0 || (!of.empty() && rest != of)) return {};
        there.insert(number), of = rest;
    }
    int count = 0; // "/N by ..."
    std::from_chars(of.data() + 1, of.data() + of.size(), count);
    count = std::min(count, most_shards);
    std::vector<std::string> names;
    for (int number = 1; number <= count; number++)
        if (there.count(number) == 0) names.push_back(fmt::format("{}/{}", number, count));
    return names;
}

std::string list(std::vector<std::string> names) {
    constexpr std::size_t most = 20;
    const std::size_t more = names.size() > most ? names.size() - most : 0;
    names.resize(names.size() - more);
    return fmt::format("{}{}", fmt::join(names, ", "),
                       more > 0 ? fmt::format(" and {} more", more) : "");
}

/// Of a part that has samples of one before it.
[[noreturn]] void refuse_double(const std::deque<FilmFile>& parts, const FilmFile& part) {
    const auto other = std::find_if(parts.begin(), parts.end(), [&](const FilmFile& p) {
        return !(p.header().state.samples & part.header().state.samples).empty();
    });
    if (other->name() == part.name()) throw InputError(part.name() + ": is given twice");
    const std::string& name = part.header().part_name;
    throw InputError(fmt::format("{}: has samples that {} has, too{}", part.name(), other->name(),
                                 name.empty() ? "" : " (part " + name + ")"));
}

} // namespace

void check_parts(const std::deque<FilmFile>& parts) {
    SampleSet all;
    for (const FilmFile& part : parts) {
        check_same(parts.front(), part);
        const SampleSet& samples = part.header().state.samples;
        if (!(all & samples).empty()) refuse_double(parts, part);
        all = all | samples;
    }
}

FilmHeader added_header(const std::deque<FilmFile>& parts) {
    FilmHeader added = parts.front().header();
    added.part_name = "";
    for (std::size_t i = 1; i < parts.size(); i++) {
        added.state.add(parts[i].header().state);
        added.part = added.part | parts[i].header().part;
    }
    // Parts that were rendered on several devices say so.
    for (auto& [name, value] : added.metadata) {
        if (name != "device") continue;
        std::set<std::string> devices;
        for (const FilmFile& part : parts)
            for (const auto& [other, device] : part.header().metadata)
                if (other == name) devices.insert(std::get<std::string>(device));
        value = fmt::format("{}", fmt::join(devices, ", "));
    }
    return added;
}

std::string missing_text(const std::deque<FilmFile>& parts, const FilmHeader& added) {
    const SampleSet missing = added.all() - added.state.samples;
    if (missing.empty()) return "";
    std::vector<std::string> stopped;
    for (const FilmFile& part : parts)
        if (part.header().state.samples != part.header().part) stopped.push_back(part.name());
    const std::vector<std::string> names = missing_names(parts);
    std::string text = fmt::format("{:.2f} % of the samples are missing",
                                   100.0 * static_cast<double>(sample_count(missing)) /
                                       static_cast<double>(sample_count(added.all())));
    if (!names.empty())
        text += fmt::format(": there is no file of part{} {}", names.size() > 1 ? "s" : "",
                            list(names));
    if (!stopped.empty())
        text += fmt::format("{} not finished: {}", names.empty() ? ":" : ";", list(stopped));
    return text;
}

} // namespace parhelion
