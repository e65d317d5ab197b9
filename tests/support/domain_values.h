// Numbers at, inside and beyond the ends of a domain, and those that programs stumble over.
#pragma once

#include "host/domain.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace parhelion::test {

/// A number as a file or a shell gives it, and what it is.
struct TriedNumber {
    std::string text;
    double value = 0.0;
};

inline TriedNumber tried(double value, bool whole) {
    return {whole ? fmt::format("{:.0f}", value) : fmt::format("{}", value), value};
}

/// Without those that the form cannot write: of whole numbers none with a fraction.
inline std::vector<TriedNumber> tried_numbers(const Domain& d) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> values{0.0, 1.0, -1.0, 2.0};
    for (double end : {d.lowest, d.highest}) {
        if (std::abs(end) == std::numeric_limits<double>::max()) continue;
        values.push_back(end);
        values.push_back(d.whole ? end - 1 : std::nextafter(end, -infinity));
        values.push_back(d.whole ? end + 1 : std::nextafter(end, infinity));
    }
    if (!d.whole)
        values.insert(values.end(), {0.5, 1e-320, -1e-320, 1e-300, 1e-45, 1e-12, 1e-6, 1e6, 1e12,
                                     1e38, 1e300, 1e308, -1e308});
    if (d.least_magnitude > 0.0)
        values.insert(values.end(), {d.least_magnitude, std::nextafter(d.least_magnitude, 0.0)});
    std::vector<TriedNumber> result;
    result.reserve(values.size() + 10);
    for (double value : values)
        result.push_back(tried(value, d.whole));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    result.insert(result.end(), {{"nan", nan},
                                 {"inf", infinity},
                                 {"-inf", -infinity},
                                 {"-0", -0.0},
                                 {"9223372036854775807", 9223372036854775807.0},
                                 {"99999999999999999999999999", 1e26},
                                 {"", nan},
                                 {"1,5", nan},
                                 {"0x10", nan},
                                 {"1e999", nan}});
    return result;
}

} // namespace parhelion::test
