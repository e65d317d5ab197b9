// Where the film holds what: its channels (kernels/device/buffers.h), and the tiles of its blocks
// in bands, each of them a buffer.
#include "host/film/film_layout.h"

namespace parhelion {

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
