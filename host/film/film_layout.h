// Where the film holds what: its channels (kernels/device/buffers.h), and the tiles of its blocks
// in bands, each of them a buffer.
#pragma once

#include "host/film/sample_window.h"
#include "host/flatten/aov_plan.h"
#include "kernels/device/buffers.h"

namespace parhelion {

/// Floats from one field or channel to the next: arrays a power of two apart would share the same
/// few places of a cache.
constexpr std::size_t odd_lines(std::size_t floats) { return 16 * ((floats + 15) / 16 | 1); }

struct FilmLayout {
    SampleWindow window;
    int aov_channels = 0;
    bool moments = false;   ///< squares of r, g, b
    bool spreads = false;   ///< how a pixel's samples spread
    bool shape_ids = false; ///< which shapes the camera's rays meet
    int band_blocks = 0;    ///< whole rows of blocks; the last band may have fewer

    int blocks() const { return static_cast<int>(window.tiles()); }
    int bands() const { return (blocks() + band_blocks - 1) / band_blocks; }
    int channels() const { return FILM_CHANNELS(aov_channels, moments, spreads); }
    /// Of what samples gather before they are added up. Those that are splatted know their offsets
    /// in their pixels.
    int result_channels() const {
        return RESULT_CHANNELS(aov_channels, window.reach > 0, shape_ids);
    }

    /// The rows of a crop in which the pixels of a band's tiles are.
    struct Rows {
        int first, end;
    };
    Rows band_rows(int band, const Film& crop) const;

    /// Words from one digit of a sum to the next.
    std::size_t stride() const { return odd_lines(band_blocks * window.tile_cells()); }
    std::size_t channel_words() const { return EXACT_WORDS * stride(); }
    /// Of a band.
    std::size_t words() const { return static_cast<std::size_t>(channels()) * channel_words(); }
    std::size_t bytes() const { return 4 * words(); }
};

/// Of the film's crop, in one band.
inline FilmLayout film_layout(const Film& film, const Integrator& integrator, const AovPlan& aovs) {
    const SampleWindow window = sample_window(film);
    return {window,
            aovs.channels,
            integrator.second_moment,
            !aovs.film_layers.empty(),
            integrator.cryptomatte.asked(),
            static_cast<int>(window.tiles())};
}
/// In as few bands as take no more than `bytes` each; of a row of blocks at least.
FilmLayout in_bands(FilmLayout layout, std::size_t bytes);
inline FilmLayout film_layout(const Scene& scene, const AovPlan& aovs) {
    return film_layout(scene.film, scene.integrator, aovs);
}

} // namespace parhelion
