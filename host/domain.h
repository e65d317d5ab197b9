// Where a number may lie and what happens beyond, written once where the number is taken.
//
// Messages, help, docs/parameters.md and the tests that walk the ends are made from it.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace parhelion {

/// What becomes of a number outside.
enum class Beyond {
    refused, ///< with one line that says what was found and what is accepted
    nearest, ///< the end is taken instead, with a note
};

/// A set of numbers. NaN and infinities are in none and are never mapped.
struct Domain {
    double lowest = std::numeric_limits<double>::lowest();
    double highest = std::numeric_limits<double>::max();
    bool above_lowest = false;  ///< the lowest itself is outside
    bool below_highest = false; ///< likewise
    bool whole = false;         ///< whole numbers only
    Beyond below = Beyond::refused;
    double mapped_from = 0.0; ///< the least that is mapped to the lowest
    /// Nearer to 0 than this is taken as 0, with a note; 0: nothing is.
    double least_magnitude = 0.0;
    std::string_view unit{};
    std::array<int, 4> only{}; ///< these alone, `only_count` of them; 0: all between the ends
    int only_count = 0;

    bool operator==(const Domain&) const = default;

    constexpr Domain in(std::string_view name) const {
        Domain domain = *this;
        domain.unit = name;
        return domain;
    }
    /// Where the lowest stands for all from `least` on.
    constexpr Domain nearest_from(double least) const {
        Domain domain = *this;
        domain.below = Beyond::nearest;
        domain.mapped_from = least;
        return domain;
    }
    constexpr Domain zero_below(double magnitude) const {
        Domain domain = *this;
        domain.least_magnitude = magnitude;
        return domain;
    }
};

constexpr Domain any_number() { return {}; }
constexpr Domain at_least(double lowest) { return {.lowest = lowest}; }
constexpr Domain greater_than(double lowest) { return {.lowest = lowest, .above_lowest = true}; }
constexpr Domain between(double lowest, double highest) {
    return {.lowest = lowest, .highest = highest};
}
constexpr Domain strictly_between(double lowest, double highest) {
    return {.lowest = lowest, .highest = highest, .above_lowest = true, .below_highest = true};
}
constexpr Domain whole_number(double lowest, double highest) {
    return {.lowest = lowest, .highest = highest, .whole = true};
}

/// What the number is taken as: itself, or the end next to it or 0 where that is what happens
/// beyond; nothing where it is refused.
std::optional<double> placed(const Domain& domain, double value);

/// "greater than 0 and less than 180 degrees", "a whole number, 1 to 65536".
std::string accepted_text(const Domain& domain);

/// "refused", or which end is taken.
std::string beyond_text(const Domain& domain);

} // namespace parhelion
