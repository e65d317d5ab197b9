// A film as the exact sums of its pixels.
#include "host/film/film_sums.h"

namespace parhelion {
namespace {

bool is_zero(std::span<const std::uint32_t> words) {
    return std::all_of(words.begin(), words.end(), [](std::uint32_t w) { return w == 0; });
}

} // namespace

DigitRange digits_in_use(const SumRow& row) {
    int first = 0, end = EXACT_WORDS;
    while (first < end && is_zero(row.digit(first)))
        first++;
    while (first < end && is_zero(row.digit(end - 1)))
        end--;
    return {static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(end - first)};
}

} // namespace parhelion
