// Unevaluated sums of two doubles: 106 bits, for differences of nearly equal sums (Dekker 1971;
// Joldes, Muller and Popescu 2017, algorithms 6 and 12).
#pragma once

#include <cmath>

namespace parhelion {

/// high + low; low is at most half a unit in the last place of high.
struct TwoDoubles {
    double high = 0, low = 0;
};

inline TwoDoubles quick_sum(double a, double b) {
    const double high = a + b;
    return {high, b - (high - a)};
}

/// Exact.
inline TwoDoubles sum_of(double a, double b) {
    const double high = a + b, of_b = high - a;
    return {high, (a - (high - of_b)) + (b - of_b)};
}

inline TwoDoubles operator+(TwoDoubles a, TwoDoubles b) {
    const TwoDoubles high = sum_of(a.high, b.high), low = sum_of(a.low, b.low);
    const TwoDoubles sum = quick_sum(high.high, high.low + low.high);
    return quick_sum(sum.high, low.low + sum.low);
}

inline TwoDoubles operator*(TwoDoubles a, TwoDoubles b) {
    const double high = a.high * b.high;
    const double low = std::fma(a.high, b.high, -high);
    return quick_sum(high, low + (a.high * b.low + a.low * b.high));
}

} // namespace parhelion
