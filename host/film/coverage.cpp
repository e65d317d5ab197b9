// How much of each pixel every shape covers.
#include "host/film/coverage.h"

#include <algorithm>
#include <tuple>

namespace parhelion {

void add_up(ShapeWeights& weights) {
    const auto before = [](const ShapeWeight& a, const ShapeWeight& b) {
        return std::tie(a.place, a.shape) < std::tie(b.place, b.shape);
    };
    std::sort(weights.begin(), weights.end(), before);
    std::size_t kept = 0;
    for (const ShapeWeight& w : weights) {
        const bool same = kept > 0 && !before(weights[kept - 1], w);
        if (same)
            weights[kept - 1].weight += w.weight;
        else
            weights[kept++] = w;
    }
    weights.resize(kept);
}

} // namespace parhelion
