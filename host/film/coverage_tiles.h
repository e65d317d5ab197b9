// Coverage by shapes while it is rendered: a tile a block, as the film has them.
#pragma once

#include "host/film/coverage.h"
#include "host/film/film_layout.h"
#include "host/film/film_sums.h"

#include <span>
#include <vector>

namespace parhelion {

/// What the slots of a wave have gathered (kernels/device/wave.h): 1 more than the shape that was
/// met first, 0 for none; the weight of the sample; its offset from its pixel's centre, empty where
/// samples are not splatted.
template<class Real>
struct WaveHits {
    std::span<const Real> shape, weight, offset_x, offset_y;
};

class CoverageTiles {
public:
    /// Of so many blocks at once, at first from block 0 on. `filter`: the values of the
    /// reconstruction filter (make_filter_values).
    CoverageTiles(const SampleWindow& window, const Film& crop, std::vector<float> filter,
                  int blocks);

    /// Forgets what there is, and goes on with the blocks from `first` on, whole rows of them.
    void turn_to(int first);

    /// Adds a wave of as many samples of each of its blocks. Several may be added at once, if they
    /// have no block in common.
    template<class Real>
    void add_wave(std::span<const WaveBlock> blocks, int samples, const WaveHits<Real>& hits);

    /// Appends what row `y` of the crop has.
    void add_row(int y, ShapeWeights& row) const;
    /// Adds the coverage of a film of this crop.
    void add_film(const FilmSums& sums);

private:
    template<class Real>
    void add_block(const WaveBlock& block, int samples, const WaveHits<Real>& hits);

    /// Of rows of tiles [first, end): those that are here.
    int first_tile_row() const { return first_ / window_.blocks_x; }
    int end_tile_row() const;
    ShapeWeights& tile(int block) { return tiles_[static_cast<std::size_t>(block - first_)]; }

    SampleWindow window_;
    Film crop_;
    std::vector<float> filter_;
    int first_ = 0;                   ///< block
    std::vector<ShapeWeights> tiles_; ///< of each block from there on, sorted; places are cells
};

} // namespace parhelion
