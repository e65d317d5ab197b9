// How long a render will take, found by rendering a little of it.
#pragma once

#include "host/progress.h"
#include "host/render/engine.h"

#include <optional>
#include <utility>
#include <vector>

namespace parhelion {

/// When a wave was on the film.
struct WaveTime {
    double seconds = 0;       ///< since the first one began
    std::int64_t samples = 0; ///< that are on the film since then, of a block each (sample_count)
};

struct RenderEstimate {
    double seconds = 0; ///< of rendering all samples
    /// What `seconds` may be off by, as a share of it: with 95 % of certainty, as far as it is by
    /// chance which part of the film was rendered. Absent where that is too little to tell.
    std::optional<double> uncertainty;
    double rendered_seconds = 0; ///< that this has taken
    double rendered_share = 0;   ///< of the samples
    double film_share = 0;       ///< of the blocks, those that have any
};

/// What `samples` are rendered in to know of all from some: runs of blocks that fill a wave each,
/// one after the other far from those before it, so that however many are taken, they lie all over
/// the film. Further samples of a block come once all blocks have had some.
class SpreadPieces {
public:
    SpreadPieces(SampleSet samples, const WaveLimits& limits)
        : samples_(std::move(samples)), limits_(limits) {}

    /// The next ones, `most` of them; fewer at the end.
    std::vector<SampleRange> next(std::size_t most);

private:
    bool next_layer();

    SampleSet samples_;
    WaveLimits limits_;
    int layer_ = 0;
    std::vector<SampleRange> pieces_; ///< of the layer, in order
    std::size_t taken_ = 0;
};

/// `waves`: of a render of so many samples, by time. The first ones, while caches are cold and
/// streams start one after the other, count for themselves; the rest of the samples will take what
/// the later ones did.
RenderEstimate estimate_of(const std::vector<WaveTime>& waves, std::int64_t samples);

/// Renders for about so many seconds; a wave that is under way then is finished. `engine` has
/// nothing of `samples` on its film, and cannot go on to a picture afterwards.
RenderEstimate estimate_render(Engine& engine, const SampleSet& samples, double seconds,
                               Progress& progress);

} // namespace parhelion
