// What the film's sums say of each pixel: means, and how its samples spread.
#include "host/film/film_reader.h"

#include <algorithm>
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

FilmReader::FilmReader(const std::vector<float>& film, const FilmLayout& layout, const Film& crop)
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
    std::vector<T> out;
    out.reserve(static_cast<std::size_t>(crop_.crop_width) * crop_.crop_height);
    for (int y = 0; y < crop_.crop_height; y++)
        for (int x = 0; x < crop_.crop_width; x++)
            out.push_back(static_cast<T>(f(x + crop_.crop_x, y + crop_.crop_y)));
    return out;
}

/// High and low part.
double FilmReader::value(int channel, std::size_t cell) const {
    std::size_t high = channel * layout_.stride() + cell;
    return double{film_[high]} + film_[high + layout_.low_part()];
}

std::vector<double> FilmReader::sums(int channel) const {
    return each_pixel<double>([&](int x, int y) {
        double total = 0;
        for_each_cell(x, y, [&](std::size_t cell) { total += value(channel, cell); });
        return total;
    });
}

std::vector<float> FilmReader::means(int channel) const {
    std::vector<double> values = sums(channel);
    std::vector<float> out(values.size());
    for (std::size_t i = 0; i < out.size(); i++)
        if (weights_[i] != 0.0) out[i] = static_cast<float>(values[i] / weights_[i]);
    return out;
}

/// Tiles join as groups of samples do on the device (spread_join).
FilmReader::Spread FilmReader::spread(int color, int x, int y) const {
    int first = layout_.spread_channel();
    Spread all;
    for_each_cell(x, y, [&](std::size_t cell) {
        double weight = value(first + spread_weight, cell);
        if (!(weight > 0)) return;
        double apart = value(first + spread_mean_r + color, cell) - all.mean;
        double share = weight / (all.weight + weight);
        all.spread +=
            value(first + spread_spread_r + color, cell) + apart * apart * all.weight * share;
        all.mean += apart * share;
        all.weight += weight;
    });
    return all;
}

std::vector<float> FilmReader::variances(int color) const {
    std::vector<double> values = sums(result_r + color);
    std::size_t i = 0;
    return each_pixel<float>([&](int x, int y) {
        double weight = weights_[i], value = values[i];
        i++;
        Spread s = spread(color, x, y);
        double samples = weight * weight / s.weight;
        if (!(samples > 1)) return std::numeric_limits<double>::quiet_NaN();
        // The mean by squared weights is another one, unless all weights are 1.
        double apart = weight == s.weight ? 0 : s.mean - value / weight;
        return (s.spread / s.weight + apart * apart) * samples / (samples - 1);
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
