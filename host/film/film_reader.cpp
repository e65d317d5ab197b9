// What the film's sums say of each pixel: means, and how its samples spread.
#include "host/film/film_reader.h"

#include "host/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parhelion {
namespace {

/// The range of tiles along one axis that hold a pixel, counted from the first block's corner.
struct TileRange {
    int first, last;

    TileRange(int pixel, int reach, int blocks)
        : first(std::max(0, (pixel - reach) / BLOCK_SIDE)),
          last(std::min(blocks - 1, (pixel + reach) / BLOCK_SIDE)) {}
};

} // namespace

FilmReader::FilmReader(std::span<const std::uint32_t> film, const FilmLayout& layout,
                       const Film& crop)
    : film_(film), layout_(layout), crop_(crop), weights_(sums(result_weight)) {}

template<class F>
void FilmReader::for_each_cell(int x, int y, F f) const {
    const SampleWindow& window = layout_.window;
    int from_x = x - window.block_x, from_y = y - window.block_y, side = TILE_SIDE(window.reach);
    TileRange columns(from_x, window.reach, window.blocks_x);
    TileRange rows(from_y, window.reach, window.blocks_y);
    for (int row = rows.first; row <= rows.last; row++)
        for (int column = columns.first; column <= columns.last; column++) {
            std::size_t tile = static_cast<std::size_t>(row) * window.blocks_x + column;
            int cell_x = from_x - BLOCK_SIDE * column + window.reach;
            int cell_y = from_y - BLOCK_SIDE * row + window.reach;
            int cell = cell_y * side + cell_x;
            f(tile * window.tile_cells() + cell);
        }
}

template<class T, class F>
std::vector<T> FilmReader::each_pixel(F f) const {
    const auto width = static_cast<std::size_t>(crop_.crop_width);
    std::vector<T> out(width * static_cast<std::size_t>(crop_.crop_height));
    parallel_for(static_cast<std::size_t>(crop_.crop_height), [&](std::size_t row) {
        for (std::size_t i = row * width; i < (row + 1) * width; i++)
            out[i] = static_cast<T>(f(static_cast<int>(i - row * width) + crop_.crop_x,
                                      static_cast<int>(row) + crop_.crop_y, i));
    });
    return out;
}

TwoDoubles FilmReader::total(int channel, int x, int y) const {
    TwoDoubles sum;
    double whole = 0; // says what is infinite
    for_each_cell(x, y, [&](std::size_t cell) {
        const TwoDoubles v =
            exact_value(&film_[channel * layout_.channel_words() + cell], layout_.stride());
        sum = sum + v, whole += v.high;
    });
    return std::isfinite(whole) ? sum : TwoDoubles{whole, 0};
}

std::vector<double> FilmReader::sums(int channel) const {
    return each_pixel<double>([&](int x, int y, std::size_t) { return total(channel, x, y).high; });
}

std::vector<float> FilmReader::means(int channel) const {
    std::vector<double> values = sums(channel);
    std::vector<float> out(values.size());
    for (std::size_t i = 0; i < out.size(); i++)
        if (weights_[i] != 0.0) out[i] = static_cast<float>(values[i] / weights_[i]);
    return out;
}

std::vector<float> FilmReader::variances(int color) const {
    const std::vector<double> values = sums(result_r + color);
    const int squares = layout_.spread_channel() + spread_weight;
    const int first = layout_.spread_channel() + spread_first_r + color;
    const int second = layout_.spread_channel() + spread_second_r + color;
    return each_pixel<float>([&](int x, int y, std::size_t i) {
        const double weight = weights_[i], mean = values[i] / weight;
        const TwoDoubles of_squares = total(squares, x, y);
        const double samples = weight * weight / of_squares.high;
        if (!(samples > 1)) return std::numeric_limits<double>::quiet_NaN();
        const TwoDoubles twice{-2 * mean, 0};
        const TwoDoubles spread = total(second, x, y) + twice * total(first, x, y) +
                                  TwoDoubles{mean, 0} * TwoDoubles{mean, 0} * of_squares;
        // It cannot be negative but for the rounding of groups.
        return std::max(spread.high, 0.0) / of_squares.high * samples / (samples - 1);
    });
}

std::vector<float> FilmReader::sample_counts() const {
    std::vector<double> squares = sums(layout_.spread_channel() + spread_weight);
    std::vector<float> out(squares.size());
    for (std::size_t i = 0; i < out.size(); i++)
        if (squares[i] > 0) out[i] = static_cast<float>(weights_[i] * weights_[i] / squares[i]);
    return out;
}

} // namespace parhelion
