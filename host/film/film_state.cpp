// What is on a film: which samples, and what was counted while they were traced.
#include "host/film/film_state.h"

#include <numeric>

namespace parhelion {

std::uint64_t non_finite_samples(const TraceCounts& counts) {
    return std::accumulate(counts.begin() + statistic_first_fault, counts.end(), std::uint64_t{0});
}

void FilmState::add(const FilmState& other) {
    samples = samples | other.samples;
    for (std::size_t i = 0; i < counts.size(); i++)
        counts[i] += other.counts[i];
    bad_samples.insert(bad_samples.end(), other.bad_samples.begin(), other.bad_samples.end());
    bad_samples = first_of(std::move(bad_samples));
}

} // namespace parhelion
