// A film that takes more memory than it may is rendered in bands, one after the other.
#include "host/film/film_bands.h"

#include <algorithm>

namespace parhelion {
namespace {

Film rows_of(Film film, int from, int count) {
    film.crop_y += from;
    film.crop_height = count;
    return film;
}

} // namespace

std::vector<Film> film_bands(const Film& film, const Integrator& integrator, const AovPlan& aovs,
                             std::size_t bytes) {
    const int height = film.crop_height;
    auto fits = [&](int rows) {
        return film_layout(rows_of(film, 0, rows), integrator, aovs).bytes() <= bytes;
    };
    int rows = height;
    if (!fits(height)) {
        // What a filter reaches beyond a band is there twice: the more rows, the less.
        int blocks = 1, too_many = (height + BLOCK_SIDE - 1) / BLOCK_SIDE;
        while (too_many - blocks > 1) {
            const int middle = (blocks + too_many) / 2;
            (fits(middle * BLOCK_SIDE) ? blocks : too_many) = middle;
        }
        rows = std::min(height, blocks * BLOCK_SIDE);
    }
    std::vector<Film> bands;
    for (int from = 0; from < height; from += rows)
        bands.push_back(rows_of(film, from, std::min(rows, height - from)));
    return bands;
}

} // namespace parhelion
