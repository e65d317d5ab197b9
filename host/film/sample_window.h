// Which pixels are sampled for a picture, in which blocks, and the tiles of film that blocks write.
#pragma once

#include "host/scene/scene.h"
#include "kernels/shared/types.h"

#include <cstddef>

namespace parhelion {

/// Pixels count from the top left corner of the full film.
struct SampleWindow {
    int x = 0, y = 0, width = 0, height = 0; ///< the pixels that are sampled
    int pixel_stride = 0;                    ///< no two pixels have the same number with it
    int block_x = 0, block_y = 0;            ///< corner of the first block
    int blocks_x = 1, blocks_y = 1;
    int reach = 0; ///< pixels that a sample counts for on each side of its own

    std::size_t tiles() const { return static_cast<std::size_t>(blocks_x) * blocks_y; }
    std::size_t tile_cells() const { return TILE_CELLS(reach); }
};

/// The crop, and around it what the filter reaches, as far as the film goes (with `sample_border`
/// beyond it). Samples and the order of their sums are those of the full film, so a crop has its
/// bits.
SampleWindow sample_window(const Film& film);

} // namespace parhelion
