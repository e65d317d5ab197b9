// Finding a plugin's reader by name in a table that is also the list of what is accepted.
#pragma once

#include "host/scene/mitsuba/document.h"
#include "host/scene/text.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace parhelion::mitsuba {

template<typename Read>
struct PluginEntry {
    std::string_view name;
    Read read;
};

template<typename Read, std::size_t N>
using PluginTable = std::array<PluginEntry<Read>, N>;

template<typename Table>
bool has_plugin(const Table& table, std::string_view name) {
    return std::any_of(table.begin(), table.end(),
                       [&](const auto& entry) { return entry.name == name; });
}

/// The table's reader of `object`; throws NotKnown naming the plugin and all that are accepted.
template<typename Read, std::size_t N>
Read find_plugin(const PluginTable<Read, N>& table, const Object& object) {
    std::string accepted;
    for (const PluginEntry<Read>& entry : table) {
        if (entry.name == object.plugin) return entry.read;
        accepted += (accepted.empty() ? "" : ", ") + std::string(entry.name);
    }
    throw NotKnown(object.location.to_string() + ": " + object.tag + " plugin " +
                   in_quotes(object.plugin) + " is not supported (accepted: " + accepted + ")");
}

} // namespace parhelion::mitsuba
