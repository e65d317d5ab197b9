// The film as kernels leave it: tiles of digits, in bands.
#include "host/film/tiled_film.h"

#include "host/parallel.h"

#include <algorithm>

namespace parhelion {
namespace {

/// The range of tiles along one axis that hold a pixel, counted from the first block's corner.
struct TileRange {
    int first, last;

    TileRange(int pixel, int reach, int blocks)
        : first(std::max(0, (pixel - reach) / BLOCK_SIDE)),
          last(std::min(blocks - 1, (pixel + reach) / BLOCK_SIDE)) {}
};

/// Words of the lowest digit of a tile's first cell, in its band.
std::size_t tile_begin(const FilmLayout& layout, int channel, int block) {
    return channel * layout.channel_words() +
           block % layout.band_blocks * layout.window.tile_cells();
}

} // namespace

TiledFilm::TiledFilm(std::vector<std::span<const std::uint32_t>> bands, const FilmLayout& layout,
                     const Film& crop, const CoverageTiles* coverage)
    : bands_(std::move(bands)), layout_(layout), crop_(crop), coverage_(coverage) {}

/// What a tile has of the row.
void TiledFilm::add_tile(int channel, int column, int tile_row, int y, SumRow& row) const {
    const SampleWindow& window = layout_.window;
    const int side = TILE_SIDE(window.reach);
    // Of the tile's corner, in the crop.
    const int left = window.block_x + BLOCK_SIDE * column - window.reach - crop_.crop_x;
    const int top = window.block_y + BLOCK_SIDE * tile_row - window.reach - crop_.crop_y;
    const int from = std::max(0, left), end = std::min(crop_.crop_width, left + side);
    if (from >= end) return;
    const int block = tile_row * window.blocks_x + column;
    const std::span band = bands_[block / layout_.band_blocks];
    if (band.empty()) return;
    const std::uint32_t* cells = &band[tile_begin(layout_, channel, block)];
    cells += (y - top) * side + (from - left);
    add_digits(row, from, end - from, [&](int k) { return cells + k * layout_.stride(); });
}

void TiledFilm::add_row(int channel, int y, SumRow& row) const {
    const SampleWindow& window = layout_.window;
    const TileRange rows(y + crop_.crop_y - window.block_y, window.reach, window.blocks_y);
    for (int tile_row = rows.first; tile_row <= rows.last; tile_row++)
        for (int column = 0; column < window.blocks_x; column++)
            add_tile(channel, column, tile_row, y, row);
}

void put_sums(const FilmSums& sums, const FilmLayout& layout, const Film& crop,
              const std::vector<std::span<std::uint32_t>>& bands) {
    const SampleWindow& window = layout.window;
    const int side = TILE_SIDE(window.reach);
    parallel_for(static_cast<std::size_t>(crop.crop_height), [&](std::size_t y) {
        SumRow row(crop.crop_width);
        const int from_y = static_cast<int>(y) + crop.crop_y - window.block_y;
        for (int channel = 0; channel < layout.channels(); channel++) {
            row.clear();
            sums.add_row(channel, static_cast<int>(y), row);
            for (int x = 0; x < crop.crop_width; x++) {
                const int from_x = x + crop.crop_x - window.block_x;
                const int block = from_y / BLOCK_SIDE * window.blocks_x + from_x / BLOCK_SIDE;
                const int cell = (from_y % BLOCK_SIDE + window.reach) * side + from_x % BLOCK_SIDE +
                                 window.reach;
                std::uint32_t* words =
                    &bands[block / layout.band_blocks][tile_begin(layout, channel, block) + cell];
                for (int k = 0; k < EXACT_WORDS; k++)
                    if (row.digit(k)[x] != 0) words[k * layout.stride()] = row.digit(k)[x];
            }
        }
    });
}

} // namespace parhelion
