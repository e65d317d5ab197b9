// Where the film holds what: its channels (kernels/device/buffers.h), and the tiles of its blocks
// in bands, each of them a buffer.
#include "host/film/film_layout.h"

#include <algorithm>

namespace parhelion {

FilmLayout::Rows FilmLayout::band_rows(int band, const Film& crop) const {
    const int top = window.block_y - crop.crop_y, side = band_blocks / window.blocks_x * BLOCK_SIDE;
    return {std::clamp(top + band * side - window.reach, 0, crop.crop_height),
            std::clamp(top + (band + 1) * side + window.reach, 0, crop.crop_height)};
}

FilmLayout in_bands(FilmLayout layout, std::size_t bytes) {
    auto of_rows = [&](int rows) {
        FilmLayout bands = layout;
        bands.band_blocks = rows * layout.window.blocks_x;
        return bands;
    };
    if (layout.bytes() <= bytes) return layout;
    int rows = 1, too_many = layout.window.blocks_y;
    while (too_many - rows > 1) {
        const int middle = (rows + too_many) / 2;
        (of_rows(middle).bytes() <= bytes ? rows : too_many) = middle;
    }
    return of_rows(rows);
}

} // namespace parhelion
