// Coverage by shapes while it is rendered.
#include "host/film/coverage_tiles.h"

#include "host/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parhelion {
namespace {

constexpr std::size_t most_cells = TILE_CELLS(FILTER_REACH_LIMIT);
constexpr int most_pixels = 2 * FILTER_REACH_LIMIT + 1;

/// The samples of one block that have met one shape.
struct TileOfShape {
    int shape;
    std::array<std::int64_t, most_cells> weights{};
};

TileOfShape& tile_of(std::vector<TileOfShape>& tiles, int shape) {
    // Neighbouring samples meet the same shapes.
    for (auto tile = tiles.rbegin(); tile != tiles.rend(); ++tile)
        if (tile->shape == shape) return *tile;
    tiles.push_back({shape});
    return tiles.back();
}

/// As kernels do (kernels/device/splat.h), in double.
double filter_value(const std::vector<float>& values, double distance) {
    const double scaled = distance * FILTER_INTERVALS;
    const auto interval = static_cast<std::size_t>(scaled);
    const double begin = values[interval], end = values[interval + 1];
    return begin + (end - begin) * (scaled - static_cast<double>(interval));
}

/// Of the pixels from -reach to reach along an axis.
std::array<double, most_pixels> axis_weights(const std::vector<float>& values, int reach,
                                             double offset) {
    std::array<double, most_pixels> weights{};
    for (int k = -reach; k <= reach; k++)
        weights[k + reach] = reach > 0 ? filter_value(values, std::fabs(k - offset)) : 1.0;
    return weights;
}

/// The pixel of a block that is the n-th in Morton order.
struct BlockPixel {
    int x, y;

    explicit BlockPixel(int n) : x((n & 1) | ((n >> 1) & 2)), y(((n >> 1) & 1) | ((n >> 2) & 2)) {}
};

/// `x`, `y`: filter weights along the axes, those along y with the sample's own.
void splat(const std::array<double, most_pixels>& x, const std::array<double, most_pixels>& y,
           BlockPixel pixel, int reach, TileOfShape& tile) {
    const int side = TILE_SIDE(reach);
    for (int j = 0; j <= 2 * reach; j++)
        for (int i = 0; i <= 2 * reach; i++)
            tile.weights[(pixel.y + j) * side + pixel.x + i] +=
                std::llrint(x[i] * y[j] / coverage_unit);
}

/// Of a tile, which is sorted, the first weight in that cell or behind it.
ShapeWeights::const_iterator first_from(const ShapeWeights& tile, int cell) {
    return std::partition_point(tile.begin(), tile.end(),
                                [cell](const ShapeWeight& w) { return w.place < cell; });
}

} // namespace

CoverageTiles::CoverageTiles(const SampleWindow& window, const Film& crop,
                             std::vector<float> filter, int blocks)
    : window_(window), crop_(crop), filter_(std::move(filter)),
      tiles_(static_cast<std::size_t>(blocks)) {}

void CoverageTiles::turn_to(int first) {
    first_ = first;
    for (ShapeWeights& tile : tiles_)
        tile = {};
}

int CoverageTiles::end_tile_row() const {
    return std::min(window_.blocks_y,
                    first_tile_row() + static_cast<int>(tiles_.size()) / window_.blocks_x);
}

template<class Real>
void CoverageTiles::add_block(const WaveBlock& block, int samples, const WaveHits<Real>& hits) {
    std::vector<TileOfShape> met;
    for (int slot = 0; slot < samples * BLOCK_PIXELS; slot++) {
        const double weight = hits.weight[slot];
        if (!(std::fabs(weight) > 0)) continue; // none, or a sample that went wrong
        const bool splatted = window_.reach > 0;
        const auto x =
            axis_weights(filter_, window_.reach, splatted ? double{hits.offset_x[slot]} : 0.0);
        auto y = axis_weights(filter_, window_.reach, splatted ? double{hits.offset_y[slot]} : 0.0);
        for (double& w : y)
            w *= weight;
        splat(x, y, BlockPixel(slot / samples), window_.reach,
              tile_of(met, static_cast<int>(hits.shape[slot]) - 1));
    }
    ShapeWeights& tile = this->tile(block.block);
    const int cells = static_cast<int>(window_.tile_cells());
    for (const TileOfShape& of_shape : met)
        for (int cell = 0; cell < cells; cell++)
            if (of_shape.weights[cell] != 0)
                tile.push_back({cell, of_shape.shape, of_shape.weights[cell]});
    add_up(tile);
}

template<class Real>
void CoverageTiles::add_wave(std::span<const WaveBlock> blocks, int samples,
                             const WaveHits<Real>& hits) {
    const std::size_t slots = static_cast<std::size_t>(samples) * BLOCK_PIXELS;
    parallel_for(blocks.size(), [&](std::size_t n) {
        const auto part = [&](std::span<const Real> of) {
            return of.empty() ? of : of.subspan(n * slots, slots);
        };
        add_block<Real>(
            blocks[n], samples,
            {part(hits.shape), part(hits.weight), part(hits.offset_x), part(hits.offset_y)});
    });
}
template void CoverageTiles::add_wave(std::span<const WaveBlock>, int, const WaveHits<float>&);
template void CoverageTiles::add_wave(std::span<const WaveBlock>, int, const WaveHits<double>&);

void CoverageTiles::add_row(int y, ShapeWeights& row) const {
    const int side = TILE_SIDE(window_.reach);
    const int from_y = y + crop_.crop_y - window_.block_y;
    const int first = std::max(first_tile_row(), (from_y - window_.reach) / BLOCK_SIDE);
    const int end = std::min(end_tile_row(), (from_y + window_.reach) / BLOCK_SIDE + 1);
    for (int tile_row = first; tile_row < end; tile_row++)
        for (int column = 0; column < window_.blocks_x; column++) {
            // Of the tile's corner: its row of cells that is this one, and where that begins.
            const int cell_row = from_y - BLOCK_SIDE * tile_row + window_.reach;
            const int left = window_.block_x + BLOCK_SIDE * column - window_.reach - crop_.crop_x;
            const ShapeWeights& tile =
                tiles_[static_cast<std::size_t>(tile_row) * window_.blocks_x + column - first_];
            for (auto w = first_from(tile, cell_row * side);
                 w != tile.end() && w->place < (cell_row + 1) * side; ++w)
                if (const int x = left + w->place % side; x >= 0 && x < crop_.crop_width)
                    row.push_back({x, w->shape, w->weight});
        }
}

void CoverageTiles::add_film(const FilmSums& sums) {
    const int side = TILE_SIDE(window_.reach);
    for (int y = 0; y < crop_.crop_height; y++) {
        ShapeWeights row;
        sums.add_coverage(y, row);
        const int from_y = y + crop_.crop_y - window_.block_y;
        for (const ShapeWeight& w : row) {
            const int from_x = w.place + crop_.crop_x - window_.block_x;
            const int block = from_y / BLOCK_SIDE * window_.blocks_x + from_x / BLOCK_SIDE;
            const int cell =
                (from_y % BLOCK_SIDE + window_.reach) * side + from_x % BLOCK_SIDE + window_.reach;
            tile(block).push_back({cell, w.shape, w.weight});
        }
    }
    parallel_for(tiles_.size(), [&](std::size_t block) { add_up(tiles_[block]); });
}

} // namespace parhelion
