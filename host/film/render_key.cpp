// What tells one render from another.
#include "host/film/render_key.h"

#include <fmt/format.h>

namespace parhelion {
namespace {

std::string value_in(const RenderKey& key, const std::string& name) {
    for (const auto& [other, value] : key)
        if (other == name) return value;
    return "";
}

/// Digests say nothing to a reader.
bool is_digest(const std::string& value) {
    return value.size() == 32 && value.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string difference(const std::string& name, const std::string& theirs,
                       const std::string& ours) {
    if (is_digest(theirs) || is_digest(ours)) {
        if (theirs.empty()) return name + " is not part of it";
        return ours.empty() ? name + " is part of it" : name + " has other contents";
    }
    const auto told = [](const std::string& value) {
        return value.empty() ? std::string("not given") : value;
    };
    return fmt::format("{}: {} there, {} here", name, told(theirs), told(ours));
}

} // namespace

std::string key_difference(const RenderKey& there, const RenderKey& here) {
    for (const RenderKey* key : {&here, &there})
        for (const auto& [name, value] : *key)
            if (value_in(there, name) != value_in(here, name))
                return difference(name, value_in(there, name), value_in(here, name));
    return there == here ? "" : "options are given in another order";
}

} // namespace parhelion
