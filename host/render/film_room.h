// Where the film of a render has room: in memory, as a whole or a band of it at a time.
#pragma once

#include "host/film/film_layout.h"
#include "host/waves/work_sizes.h"

#include <cstdint>

namespace parhelion {

struct FilmRoom {
    std::uint64_t bytes = 0;  ///< that the film may take in memory
    std::uint64_t buffer = 0; ///< that one buffer may have
};

/// In bands that fit; where not all of them do together, `split` says that they take turns. Throws
/// InputError where not even one row of blocks has room.
FilmLayout film_in_room(const Scene& scene, const AovPlan& aovs, const FilmRoom& room,
                        WorkSplit& split);

} // namespace parhelion
