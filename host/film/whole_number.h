// Whole numbers in JSON that anybody may have written.
#pragma once

#include "host/error.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <limits>

namespace parhelion {

/// Throws InputError for what is no number of an int.
inline int whole_number(const nlohmann::json& json) {
    using Limits = std::numeric_limits<int>;
    const bool small = json.is_number_unsigned()
                           ? json.get<std::uint64_t>() <= Limits::max()
                           : json.is_number_integer() && json.get<std::int64_t>() >= Limits::min();
    if (!small) throw InputError("a number is not whole, or too large");
    return json.get<int>();
}

} // namespace parhelion
