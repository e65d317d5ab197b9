// Which pixels are sampled for a picture, in which blocks, and the tiles of film that blocks write.
#include "host/film/sample_window.h"

#include "host/flatten/filter_table.h"

#include <algorithm>

namespace parhelion {
namespace {

/// One axis of the window.
struct Span {
    int first, length; // pixels
    int block, blocks;
};

Span sampled_span(int crop, int crop_length, int film_length, int reach, int border) {
    int first = std::max(crop - reach, -border);
    int end = std::min(crop + crop_length + reach, film_length + border);
    // Tiles add up in the same groups for any crop: blocks stand where the full film has them. Its
    // border lies in a block of its own, for reaches up to a block's side.
    static_assert(FILTER_REACH_LIMIT <= BLOCK_SIDE);
    int before = reach > 0 ? (first + BLOCK_SIDE) % BLOCK_SIDE : 0;
    int block = first - before;
    return {first, end - first, block, (end - block + BLOCK_SIDE - 1) / BLOCK_SIDE};
}

} // namespace

SampleWindow sample_window(const Film& film) {
    int reach = filter_reach(film), border = film.sample_border ? reach : 0;
    Span x = sampled_span(film.crop_x, film.crop_width, film.width, reach, border);
    Span y = sampled_span(film.crop_y, film.crop_height, film.height, reach, border);
    return {x.first, y.first, x.length, y.length, film.width + 2 * border,
            x.block, y.block, x.blocks, y.blocks, reach};
}

} // namespace parhelion
