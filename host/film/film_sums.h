// A film as the exact sums of its pixels: what a picture is made of, and what parts of a render
// have in common.
#pragma once

#include "host/film/coverage.h"
#include "kernels/shared/types.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace parhelion {

struct DigitRange {
    std::uint8_t first = 0, count = 0;
};

/// Digits of the sums of a channel over a row of pixels (kernels/shared/exact_sum.h): first the
/// lowest of all pixels, then the next.
class SumRow {
public:
    explicit SumRow(int width) : width_(width), words_(EXACT_WORDS * width_) {}

    std::size_t width() const { return width_; }
    std::span<std::uint32_t> digit(int k) { return std::span(words_).subspan(k * width_, width_); }
    std::span<const std::uint32_t> digit(int k) const {
        return std::span(words_).subspan(k * width_, width_);
    }
    /// Those of a range, of all pixels.
    std::span<std::uint32_t> digits(DigitRange range) {
        return std::span(words_).subspan(range.first * width_, range.count * width_);
    }
    void clear() { std::fill(words_.begin(), words_.end(), 0u); }

private:
    std::size_t width_;
    std::vector<std::uint32_t> words_;
};

/// From the first to the last digit that is not 0 in all of a row; none of a row of zeros.
DigitRange digits_in_use(const SumRow& row);

/// Adds numbers to `count` sums. `digit(k)`: the k-th digits of the numbers, in a row.
template<class Digit>
void add_digits(SumRow& sums, std::size_t first, std::size_t count, Digit digit) {
    // No tile is wider.
    constexpr std::size_t most = TILE_SIDE(FILTER_REACH_LIMIT);
    for (std::size_t from = 0; from < count; from += most) {
        std::array<std::uint32_t, most> carry{};
        const std::size_t some = std::min(most, count - from);
        for (int k = 0; k < EXACT_WORDS; k++) {
            std::uint32_t* sum = &sums.digit(k)[first + from];
            const std::uint32_t* added = digit(k) + from;
            for (std::size_t i = 0; i < some; i++) {
                const std::uint64_t wide = std::uint64_t{sum[i]} + added[i] + carry[i];
                sum[i] = static_cast<std::uint32_t>(wide);
                carry[i] = static_cast<std::uint32_t>(wide >> 32);
            }
        }
    }
}

/// Of any film. Rows may be read by several threads.
class FilmSums {
public:
    FilmSums() = default;
    virtual ~FilmSums() = default;
    FilmSums(const FilmSums&) = delete;
    FilmSums& operator=(const FilmSums&) = delete;

    /// Adds the sums of channel `channel` over row `y`, counted in the crop, to `row`.
    virtual void add_row(int channel, int y, SumRow& row) const = 0;
    /// Appends what shapes weigh in the pixels of row `y`, in any order; nothing where that is not
    /// known. Places are columns of the crop.
    virtual void add_coverage(int /*y*/, ShapeWeights& /*row*/) const {}
};

} // namespace parhelion
