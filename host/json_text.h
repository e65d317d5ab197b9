// JSON as text.
#pragma once

#include "host/safe_text.h"

#include <nlohmann/json.hpp>

#include <string>

namespace parhelion {

/// Indented, with a line end, fit for a terminal. JSON holds UTF-8 alone: bytes of a name that are
/// none become U+FFFD.
template<class Json>
std::string json_text(const Json& json) {
    return safe_text(json.dump(2, ' ', false, Json::error_handler_t::replace)) + '\n';
}

/// The same in one line.
template<class Json>
std::string json_line(const Json& json) {
    return safe_text(json.dump(-1, ' ', false, Json::error_handler_t::replace)) + '\n';
}

} // namespace parhelion
