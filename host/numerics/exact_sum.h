// One sum as the film keeps it, as its kernel adds to it.
#pragma once

#include "host/film/exact_value.h"
#include "host/numerics/measure.h"

#include <array>

namespace parhelion::numerics {

class ExactSum {
public:
    void add(float v) {
        const f32::ExactPart part = f32::exact_part(v);
        std::uint32_t carry = 0;
        for (int k = v == 0 ? EXACT_WORDS : part.word; k < EXACT_WORDS; k++) {
            const f32::ExactDigit sum = f32::exact_digit(part, k, digits_.at(k), carry);
            digits_.at(k) = sum.digit, carry = sum.carry;
            if (!f32::exact_goes_on(part, k, carry)) return;
        }
    }
    void add(f32::TwoReal v) { add(v.high), add(v.low); }

    TwoDoubles value() const { return exact_value(digits_.data(), 1); }
    const std::array<std::uint32_t, EXACT_WORDS>& digits() const { return digits_; }

private:
    std::array<std::uint32_t, EXACT_WORDS> digits_{};
};

/// Of a pixel's samples: sums of g, g x and g x^2, g being the squares of their weights.
struct ExactSpread {
    ExactSum weight, first, second;

    void add(const f32::GroupSpread& g) {
        const f32::SpreadTerms terms = f32::spread_terms(g);
        weight.add(g.weight);
        for (float term : terms.first)
            first.add(term);
        for (float term : terms.second)
            second.add(term);
    }
    /// Sum of g (x - mean)^2.
    double about(double mean) const {
        return (second.value() + TwoDoubles{-2 * mean, 0} * first.value() +
                TwoDoubles{mean, 0} * TwoDoubles{mean, 0} * weight.value())
            .high;
    }
};

} // namespace parhelion::numerics
