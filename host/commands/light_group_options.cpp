// The light groups that a command line asks for.
#include "host/commands/light_group_options.h"

#include "host/commands/nearest_name.h"
#include "host/error.h"
#include "host/flatten/light_groups.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace parhelion {
namespace {

constexpr const char* rest_name = "rest";
constexpr std::size_t longest_name = 200; ///< EXR has 255 for the name of a channel
constexpr std::size_t ids_told = 20;

/// What an emitter can be called by, its own id first.
struct EmitterIds {
    std::string own, of_shape;

    const std::string& first() const { return own.empty() ? of_shape : own; }
};

std::vector<EmitterIds> emitter_ids(const Scene& scene) {
    std::vector<EmitterIds> ids;
    for (const Shape& shape : scene.shapes)
        if (shape.radiance) ids.push_back({shape.emitter_id, shape.id});
    for (std::size_t i = 0; i < scene.emitters.size(); i++)
        ids.push_back({std::string(id_of_emitter(scene, i)), ""});
    return ids;
}

LightGroup parse_group(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string ids = equals == std::string::npos ? text : text.substr(equals + 1);
    LightGroup group{text.substr(0, equals), {}};
    for (std::size_t begin = 0; begin <= ids.size();) {
        const std::size_t end = std::min(ids.find(',', begin), ids.size());
        group.ids.push_back(ids.substr(begin, end - begin));
        begin = end + 1;
    }
    const bool empty = std::any_of(group.ids.begin(), group.ids.end(),
                                   [](const std::string& id) { return id.empty(); });
    if (group.name.empty() || empty)
        throw InputError(
            fmt::format("--light-group '{}': expected NAME=ID,ID,... or ID, e.g. key=lamp", text));
    return group;
}

void check_name(const std::string& name, std::set<std::string>& names) {
    if (name == rest_name)
        throw InputError(fmt::format("--light-group: '{}' is what no group has (accepted: another "
                                     "name, NAME=ID)",
                                     rest_name));
    if (name.size() > longest_name)
        throw InputError(fmt::format("--light-group: the name '{}...' is longer than {} bytes",
                                     name.substr(0, 20), longest_name));
    if (!names.insert(name).second)
        throw InputError(fmt::format("--light-group: there are two groups '{}'", name));
}

[[noreturn]] void refuse_id(const std::string& id, const std::vector<EmitterIds>& emitters) {
    std::set<std::string> known;
    for (const EmitterIds& e : emitters)
        for (const std::string& name : {e.own, e.of_shape})
            if (!name.empty()) known.insert(name);
    std::vector<std::string> names(known.begin(), known.end());
    const std::string near = nearest_name(id, names);
    const bool more = names.size() > ids_told;
    if (more) names.resize(ids_told);
    throw InputError(fmt::format(
        "--light-group: no emitter, nor a shape with one, has the id '{}'{}; {}", id,
        near.empty() ? "" : fmt::format(" (is it '{}'?)", near),
        names.empty()
            ? "none has an id"
            : fmt::format("there are {}{}", fmt::join(names, ", "), more ? ", ..." : "")));
}

void check_ids(const LightGroup& group, const std::vector<EmitterIds>& emitters) {
    for (const std::string& id : group.ids)
        if (std::none_of(emitters.begin(), emitters.end(),
                         [&](const EmitterIds& e) { return e.own == id || e.of_shape == id; }))
            refuse_id(id, emitters);
}

bool has(const LightGroup& group, const EmitterIds& emitter) {
    const auto named = [&](const std::string& id) {
        return !id.empty() && std::find(group.ids.begin(), group.ids.end(), id) != group.ids.end();
    };
    return named(emitter.own) || named(emitter.of_shape);
}

/// The groups that have an emitter; refuses two.
std::size_t count_groups(const std::vector<LightGroup>& groups, const EmitterIds& emitter) {
    std::vector<std::string> names;
    for (const LightGroup& group : groups)
        if (has(group, emitter)) names.push_back(group.name);
    if (names.size() > 1)
        throw InputError(fmt::format("--light-group: the emitter '{}' is in more than one group: "
                                     "{} (accepted: one)",
                                     emitter.first(), fmt::join(names, ", ")));
    return names.size();
}

void check_integrator(IntegratorKind kind) {
    if (kind != IntegratorKind::path && kind != IntegratorKind::direct)
        throw InputError(fmt::format("--light-group: the integrator {} gathers no light (accepted: "
                                     "path, direct)",
                                     integrator_names[static_cast<std::size_t>(kind)]));
}

void check_count(std::size_t count) {
    if (count > most_light_groups)
        throw InputError(
            fmt::format("--light-group: {} groups are too many (accepted: up to {}, of "
                        "several emitters each: NAME=ID,ID,...)",
                        count, most_light_groups));
}

} // namespace

std::vector<LightGroup> light_groups(const std::vector<std::string>& asked, bool by_light,
                                     const Scene& scene) {
    check_integrator(scene.integrator.kind);
    const std::vector<EmitterIds> emitters = emitter_ids(scene);
    std::vector<LightGroup> groups;
    std::set<std::string> names;
    for (const std::string& text : asked) {
        groups.push_back(parse_group(text));
        check_name(groups.back().name, names);
        check_ids(groups.back(), emitters);
    }
    bool rest = emitters.empty();
    for (const EmitterIds& emitter : emitters) {
        if (count_groups(groups, emitter) > 0) continue;
        if (by_light && !emitter.first().empty()) {
            check_name(emitter.first(), names);
            groups.push_back({emitter.first(), {emitter.first()}});
        } else {
            rest = true;
        }
    }
    if (rest) groups.push_back({rest_name, {}});
    check_count(groups.size());
    return groups;
}

} // namespace parhelion
