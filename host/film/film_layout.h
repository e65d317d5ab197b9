// Where the film holds what: its channels (kernels/device/buffers.h) and their tiles.
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
    bool moments = false; ///< squares of r, g, b
    bool spreads = false; ///< how a pixel's samples spread

    int channels() const { return FILM_CHANNELS(aov_channels, moments, spreads); }
    int square_channel() const { return SQUARE_CHANNEL(aov_channels); }
    int spread_channel() const { return SPREAD_CHANNEL(aov_channels, moments); }
    /// Of what samples gather before they are added up. Those that are splatted know their offsets
    /// in their pixels.
    int result_channels() const { return RESULT_CHANNELS(aov_channels, window.reach > 0); }

    /// Words from one digit of a sum to the next.
    std::size_t stride() const { return odd_lines(window.tiles() * window.tile_cells()); }
    std::size_t channel_words() const { return EXACT_WORDS * stride(); }
    std::size_t words() const { return static_cast<std::size_t>(channels()) * channel_words(); }
    std::size_t bytes() const { return 4 * words(); }
};

/// Of the film's crop.
inline FilmLayout film_layout(const Film& film, const Integrator& integrator, const AovPlan& aovs) {
    return {sample_window(film), aovs.channels, integrator.second_moment,
            !aovs.film_layers.empty()};
}
inline FilmLayout film_layout(const Scene& scene, const AovPlan& aovs) {
    return film_layout(scene.film, scene.integrator, aovs);
}

} // namespace parhelion
