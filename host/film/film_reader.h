// What the film's sums say of each pixel: means, and how its samples spread.
#pragma once

#include "host/film/film_sums.h"
#include "host/film/two_doubles.h"

#include <vector>

namespace parhelion {

/// The film's channels over some rows of a crop, row by row.
class FilmReader {
public:
    /// `height` rows from `first_row` on. `sums` must outlive the reader, and be that wide.
    FilmReader(const FilmSums& sums, int width, int first_row, int height);

    /// Sum over weight. 0 where there is no sample, or where filter weights cancel exactly.
    std::vector<float> means(int channel) const;

    /// Variance of one sample, and how many samples of that variance (independent ones, of equal
    /// weight) the pixel's value is as good as: the value's own variance is one over the other.
    /// `spread_channel`: the film's first.
    ///
    /// With w the filter's weight of a sample, x its value and m the pixel's: samples is
    /// n = (sum of w)^2 / sum of w^2 (Kish 1965), variance is sum of w^2 (x - m)^2 / sum of w^2
    /// times n / (n - 1); with a filter no wider than a pixel the number of samples that were
    /// finite, and the unbiased estimate. The variance is NaN where n is not above 1: one sample
    /// does not say how far the next may be from it.
    std::vector<float> variances(int spread_channel, int color) const;
    std::vector<float> sample_counts(int spread_channel) const;

private:
    /// f(values of channels over a row, index of its first pixel), for each row.
    template<std::size_t N, class F>
    void each_row(const std::array<int, N>& channels, F f) const;

    const FilmSums& sums_;
    std::size_t width_, first_row_, height_;
    std::vector<double> weights_;
};

} // namespace parhelion
