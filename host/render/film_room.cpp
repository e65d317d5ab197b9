// Where the film of a render has room.
#include "host/render/film_room.h"

#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace parhelion {

FilmLayout film_in_room(const Scene& scene, const AovPlan& aovs, const FilmRoom& room,
                        WorkSplit& split) {
    const FilmLayout whole = film_layout(scene, aovs);
    split.bands_in_turn |= whole.bytes() > room.bytes;
    const std::uint64_t most = std::min(room.buffer, room.bytes);
    const FilmLayout layout = in_bands(whole, split.film_bytes > 0 ? split.film_bytes : most);
    if (layout.bytes() > most)
        throw InputError(fmt::format(
            "{}: {} rows of a film of {} pixels a row and {} channels take {:.1f} MB; there is "
            "room for {:.1f} MB (accepted: a smaller --size, or a part of it, --crop)",
            scene.file, BLOCK_SIDE, scene.film.crop_width, layout.channels(),
            static_cast<double>(layout.bytes()) / 1e6, static_cast<double>(most) / 1e6));
    return layout;
}

} // namespace parhelion
