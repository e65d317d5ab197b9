// Domains of numbers that both a scene file and the command line can give.
#pragma once

#include "host/domain.h"

#include <cstdint>
#include <limits>

namespace parhelion {

inline constexpr double largest_int = std::numeric_limits<std::int32_t>::max();

inline constexpr Domain film_side_domain = whole_number(1, 65536).in("pixels");
inline constexpr std::int64_t most_film_pixels = std::int64_t{1} << 28; ///< width times height
inline constexpr Domain crop_offset_domain = whole_number(0, 65535).in("pixels");
inline constexpr Domain samples_per_pixel_domain = whole_number(1, largest_int);
inline constexpr Domain seed_domain = whole_number(0, std::numeric_limits<std::uint32_t>::max());
inline constexpr Domain max_depth_domain = whole_number(-1, largest_int);
inline constexpr Domain rr_depth_domain = whole_number(1, largest_int);

} // namespace parhelion
