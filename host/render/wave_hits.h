// What the camera's rays of a wave have met, from its results to the coverage of the film.
#pragma once

#include "host/film/coverage_tiles.h"
#include "host/waves/wave.h"

namespace parhelion {

/// `read(channel)`: what the slots of the wave have of a channel of results, as a vector or a span.
template<class Real, class Read>
void add_hits(CoverageTiles& coverage, const Wave& wave, const FilmLayout& layout,
              const Read& read) {
    const bool splatted = layout.window.reach > 0;
    const int offset = AOV_CHANNEL(layout.aov_channels);
    const auto shape = read(SHAPE_CHANNEL(layout.aov_channels, splatted));
    auto weight = read(static_cast<int>(result_weight));
    decltype(weight) x{}, y{};
    if (splatted) x = read(offset), y = read(offset + 1);
    coverage.add_wave<Real>(wave_blocks(wave), wave.samples(), {shape, weight, x, y});
}

} // namespace parhelion
