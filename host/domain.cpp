// Where a number may lie and what happens beyond.
#include "host/domain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace parhelion {
namespace {

/// Whole numbers with all their digits.
std::string text_of(double value) {
    constexpr double largest = 9007199254740992.0; // 2^53
    if (std::abs(value) < largest && value == std::trunc(value))
        return fmt::format("{}", static_cast<std::int64_t>(value));
    return fmt::format("{:g}", value);
}

std::string ends_text(const Domain& d) {
    bool low = d.lowest > Domain{}.lowest, high = d.highest < Domain{}.highest;
    std::string lowest = text_of(d.lowest), highest = text_of(d.highest);
    if (low && high && !d.above_lowest && !d.below_highest)
        return fmt::format("{} to {}", lowest, highest);
    std::string from = d.above_lowest ? "greater than " + lowest
                       : high         ? "at least " + lowest
                                      : lowest + " or greater";
    std::string to = (d.below_highest ? "less than " : "at most ") + highest;
    if (low && high) return from + " and " + to;
    return low ? from : high ? to : "";
}

} // namespace

std::optional<double> placed(const Domain& d, double value) {
    if (!std::isfinite(value) || (d.whole && value != std::trunc(value))) return std::nullopt;
    if (d.only_count > 0) {
        const int* end = d.only.data() + d.only_count;
        return std::find(d.only.data(), end, value) != end ? std::optional(value) : std::nullopt;
    }
    if (value < d.lowest || (d.above_lowest && value == d.lowest)) {
        bool mapped = d.below == Beyond::nearest && value >= d.mapped_from;
        return mapped ? std::optional(d.lowest) : std::nullopt;
    }
    if (value > d.highest || (d.below_highest && value == d.highest)) return std::nullopt;
    return std::abs(value) < d.least_magnitude ? 0.0 : value;
}

std::string accepted_text(const Domain& d) {
    if (d.only_count > 0)
        return fmt::format("{}", fmt::join(d.only.data(), d.only.data() + d.only_count, ", "));
    std::string text = ends_text(d);
    std::string_view kind = d.whole ? "a whole number" : "a finite number";
    if (text.empty())
        return d.unit.empty() ? std::string(kind) : fmt::format("{} of {}", kind, d.unit);
    if (d.whole) text = fmt::format("{}, {}", kind, text);
    return d.unit.empty() ? text : fmt::format("{} {}", text, d.unit);
}

std::string beyond_text(const Domain& d) {
    std::string mapped;
    if (d.below == Beyond::nearest)
        mapped = fmt::format("{} to {} is taken as {}", text_of(d.mapped_from), text_of(d.lowest),
                             text_of(d.lowest));
    if (d.least_magnitude > 0.0)
        mapped = fmt::format("nearer to 0 than {:g} is taken as 0", d.least_magnitude);
    return mapped.empty() ? "refused" : mapped + ", with a note; else refused";
}

} // namespace parhelion
