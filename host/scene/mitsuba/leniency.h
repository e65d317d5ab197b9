// What --lenient takes in the place of a plugin that is not known.
#pragma once

#include "host/scene/mitsuba/plugin_table.h"

#include <optional>
#include <string>
#include <vector>

namespace parhelion::mitsuba {

/// `object` as the plugin that is nearest to it, with those of its parameters that mean the same
/// there; nothing for a kind of plugin that is left out instead. Says so in `notes`.
std::optional<Object> nearest_kin(const Document& document, const Object& object,
                                  std::vector<std::string>& notes);

/// The same plugin, where its name is one of the table's but for upper case.
template<typename Table>
std::optional<Object> same_in_lower_case(const Table& table, const Object& object) {
    const std::string name = lower_case(object.plugin);
    if (!has_plugin(table, name)) return std::nullopt;
    Object known = object;
    known.plugin = name;
    return known;
}

/// Nothing for a plugin of the table, and where the document is not read leniently.
template<typename Table>
std::optional<Object> kin_outside(const Table& table, const Document& document,
                                  const Object& object, std::vector<std::string>& notes) {
    if (!document.lenient || has_plugin(table, object.plugin)) return std::nullopt;
    if (auto known = same_in_lower_case(table, object)) return known;
    return nearest_kin(document, object, notes);
}

} // namespace parhelion::mitsuba
