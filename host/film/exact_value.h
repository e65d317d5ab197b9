// The film's sums, digit by digit, as doubles.
#pragma once

#include "host/film/two_doubles.h"
#include "kernels/shared/types.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace parhelion {

/// A sum as kernels/shared/exact_sum.h keeps it, its digits `stride` words apart: within 2^-96 of
/// its value; infinite from 2^139 on, which only infinite numbers come to.
inline TwoDoubles exact_value(const std::uint32_t* digits, std::size_t stride) {
    // Of a negative sum the digits of its opposite: each turned, and 1 added, which goes on while
    // they are 0.
    const bool negative = (digits[(EXACT_WORDS - 1) * stride] >> 31) != 0;
    int top = EXACT_WORDS - 1;
    auto digit = [&](int k) -> std::uint64_t {
        return negative ? ~digits[k * stride] : digits[k * stride];
    };
    while (top > 3 && digit(top) == 0)
        top--;
    std::uint64_t upper = digit(top) << 32 | digit(top - 1);
    std::uint64_t lower = digit(top - 2) << 32 | digit(top - 3);
    if (negative) {
        bool arrives = true;
        for (int k = 0; k < top - 3 && arrives; k++)
            arrives = digits[k * stride] == 0;
        if (arrives && ++lower == 0 && ++upper == 0) upper = std::uint64_t{1} << 32, top++;
    }
    const double sign = negative ? -1 : 1;
    if (top == EXACT_WORDS - 1) // from 2^139 on
        return {sign * std::numeric_limits<double>::infinity(), 0};
    // From the highest bit on that is not 0, so that two doubles hold as much as they can.
    int exponent = 32 * (top - 1) - 149;
    if (upper == 0) upper = std::exchange(lower, 0), exponent -= 64;
    if (upper == 0) return {0, 0};
    if (const int spare = std::countl_zero(upper); spare > 0) {
        upper = upper << spare | lower >> (64 - spare);
        lower <<= spare, exponent -= spare;
    }
    constexpr std::uint64_t below = 1u << 11;
    const double high = static_cast<double>(upper - upper % below);
    const double low = static_cast<double>(upper % below) + static_cast<double>(lower) * 0x1p-64;
    const double unit = sign * std::ldexp(1.0, exponent);
    return quick_sum(high * unit, low * unit);
}

} // namespace parhelion
