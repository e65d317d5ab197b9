// What the film's sums say of each pixel: means, and how its samples spread.
#include "host/film/film_reader.h"

#include "host/film/exact_value.h"
#include "host/parallel.h"
#include "kernels/device/buffers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parhelion {
namespace {

std::vector<TwoDoubles> values(const SumRow& row) {
    std::vector<TwoDoubles> out(row.width());
    for (std::size_t x = 0; x < out.size(); x++) {
        out[x] = exact_value(&row.digit(0)[x], row.width());
        if (!std::isfinite(out[x].high)) out[x].low = 0;
    }
    return out;
}

} // namespace

FilmReader::FilmReader(const FilmSums& sums, int width, int first_row, int height)
    : sums_(sums), width_(width), first_row_(first_row), height_(height),
      weights_(width_ * height_) {
    each_row(std::array{static_cast<int>(result_weight)}, [&](const auto& of, std::size_t first) {
        for (std::size_t x = 0; x < width_; x++)
            weights_[first + x] = of[0][x].high;
    });
}

template<std::size_t N, class F>
void FilmReader::each_row(const std::array<int, N>& channels, F f) const {
    parallel_for(height_, [&](std::size_t y) {
        std::array<std::vector<TwoDoubles>, N> of_channels;
        SumRow row(static_cast<int>(width_));
        for (std::size_t i = 0; i < N; i++) {
            row.clear();
            sums_.add_row(channels[i], static_cast<int>(first_row_ + y), row);
            of_channels[i] = values(row);
        }
        f(of_channels, y * width_);
    });
}

std::vector<float> FilmReader::means(int channel) const {
    std::vector<float> out(weights_.size());
    each_row(std::array{channel}, [&](const auto& of, std::size_t first) {
        for (std::size_t x = 0; x < width_; x++) {
            const double weight = weights_[first + x];
            if (weight != 0.0) out[first + x] = static_cast<float>(of[0][x].high / weight);
        }
    });
    return out;
}

std::vector<float> FilmReader::variances(int spread_channel, int color) const {
    std::vector<float> out(weights_.size());
    const std::array channels{result_r + color, spread_channel + spread_weight,
                              spread_channel + spread_first_r + color,
                              spread_channel + spread_second_r + color};
    each_row(channels, [&](const auto& of, std::size_t begin) {
        const auto& [sums, squares, first, second] = of;
        for (std::size_t x = 0; x < width_; x++) {
            const double weight = weights_[begin + x], mean = sums[x].high / weight;
            const double samples = weight * weight / squares[x].high;
            if (!(samples > 1)) {
                out[begin + x] = std::numeric_limits<float>::quiet_NaN();
                continue;
            }
            const TwoDoubles twice{-2 * mean, 0};
            const TwoDoubles spread = second[x] + twice * first[x] +
                                      TwoDoubles{mean, 0} * TwoDoubles{mean, 0} * squares[x];
            // It cannot be negative but for the rounding of groups.
            out[begin + x] = static_cast<float>(std::max(spread.high, 0.0) / squares[x].high *
                                                samples / (samples - 1));
        }
    });
    return out;
}

std::vector<float> FilmReader::sample_counts(int spread_channel) const {
    std::vector<float> out(weights_.size());
    each_row(std::array{spread_channel + static_cast<int>(spread_weight)},
             [&](const auto& of, std::size_t first) {
                 for (std::size_t x = 0; x < width_; x++) {
                     const double weight = weights_[first + x], squares = of[0][x].high;
                     if (squares > 0)
                         out[first + x] = static_cast<float>(weight * weight / squares);
                 }
             });
    return out;
}

} // namespace parhelion
