// Whether pairs of random numbers fill the unit square evenly.
#pragma once

#include "host/numerics/statistics.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace parhelion::test {

/// Which sixteenth of [0, 1) a number is in; an integer counts in 2^-32.
inline std::size_t sixteenth(double x) { return static_cast<std::size_t>(x * 16); }
inline std::size_t sixteenth(std::uint32_t x) { return x >> 28; }

/// p-value that the pairs (first, second) of 0 .. count - 1 fill a 16 x 16 grid evenly.
template<class F>
double grid_p_value(const F& pair, int count) {
    std::vector<double> observed(256), expected(256, count / 256.0);
    for (int n = 0; n < count; n++) {
        auto [x, y] = pair(static_cast<std::uint32_t>(n));
        observed[sixteenth(x) * 16 + sixteenth(y)]++;
    }
    return numerics::chi_square_p(observed, expected);
}

} // namespace parhelion::test
