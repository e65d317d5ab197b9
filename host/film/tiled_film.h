// The film as kernels leave it: tiles of digits, in bands.
#pragma once

#include "host/film/coverage_tiles.h"
#include "host/film/film_layout.h"
#include "host/film/film_sums.h"

namespace parhelion {

class TiledFilm : public FilmSums {
public:
    /// The bands' words (none of those that are not there) and what is known of shapes (null:
    /// nothing), which must outlive it.
    TiledFilm(std::vector<std::span<const std::uint32_t>> bands, const FilmLayout& layout,
              const Film& crop, const CoverageTiles* coverage = nullptr);

    void add_row(int channel, int y, SumRow& row) const override;
    void add_coverage(int y, ShapeWeights& row) const override {
        if (coverage_) coverage_->add_row(y, row);
    }

private:
    void add_tile(int channel, int column, int tile_row, int y, SumRow& row) const;

    std::vector<std::span<const std::uint32_t>> bands_;
    FilmLayout layout_;
    Film crop_;
    const CoverageTiles* coverage_;
};

/// Puts sums where the pixels' own blocks have them. `bands`: all zero.
void put_sums(const FilmSums& sums, const FilmLayout& layout, const Film& crop,
              const std::vector<std::span<std::uint32_t>>& bands);

} // namespace parhelion
