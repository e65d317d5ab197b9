// What the film's sums say of each pixel: means, and how its samples spread.
#pragma once

#include "host/film/exact_value.h"
#include "host/film/film_layout.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace parhelion {

/// The film's channels over the pixels of a crop, row by row; each channel is read over all tiles
/// that hold the pixel, in their order.
class FilmReader {
public:
    /// All must outlive the reader. `film` as the accumulate kernel leaves it.
    FilmReader(std::span<const std::uint32_t> film, const FilmLayout& layout, const Film& crop);

    /// Sum over weight. 0 where there is no sample, or where filter weights cancel exactly.
    std::vector<float> means(int channel) const;

    /// Variance of one sample, and how many samples of that variance (independent ones, of equal
    /// weight) the pixel's value is as good as: the value's own variance is one over the other.
    ///
    /// With w the filter's weight of a sample, x its value and m the pixel's: samples is
    /// n = (sum of w)^2 / sum of w^2 (Kish 1965), variance is sum of w^2 (x - m)^2 / sum of w^2
    /// times n / (n - 1); with a filter no wider than a pixel the number of samples that were
    /// finite, and the unbiased estimate. The variance is NaN where n is not above 1: one sample
    /// does not say how far the next may be from it.
    std::vector<float> variances(int color) const;
    std::vector<float> sample_counts() const;

private:
    /// Calls f with the index into a channel of each cell that is part of a pixel.
    template<class F>
    void for_each_cell(int x, int y, F f) const;
    std::vector<double> sums(int channel) const;
    TwoDoubles total(int channel, int x, int y) const;
    /// One value a pixel: f(x, y, i), x and y in pixels of the full film, i counted in the crop.
    template<class T, class F>
    std::vector<T> each_pixel(F f) const;

    std::span<const std::uint32_t> film_;
    const FilmLayout& layout_;
    const Film& crop_;
    std::vector<double> weights_;
};

} // namespace parhelion
