// A film that takes more memory than it may is rendered in bands, one after the other.
#pragma once

#include "host/film/film_layout.h"

#include <cstddef>
#include <vector>

namespace parhelion {

/// Crops of the film's crop, from top to bottom, each of as many rows as keep its sums within
/// `bytes`; of whole blocks, at least one row of them. What is rendered of them has the bits of the
/// whole, for a crop has.
std::vector<Film> film_bands(const Film& film, const Integrator& integrator, const AovPlan& aovs,
                             std::size_t bytes);

} // namespace parhelion
