// What is on a film: which samples, and what was counted while they were traced.
#pragma once

#include "host/film/bad_samples.h"
#include "host/film/sample_set.h"

#include <array>
#include <cstdint>

namespace parhelion {

/// STATISTICS, and of FAULTS how many samples each has cost.
using TraceCounts = std::array<std::uint64_t, statistic_count>;

std::uint64_t non_finite_samples(const TraceCounts& counts);

struct FilmState {
    SampleSet samples;
    TraceCounts counts{};
    std::vector<BadSample> bad_samples; ///< as first_bad_samples has them

    /// Of two films that have no sample in common.
    void add(const FilmState& other);
};

} // namespace parhelion
