// What the help says of the cache of compiled kernels.
#pragma once

namespace parhelion {

/// For the help of subcommands that compile kernels.
inline constexpr const char* cache_help =
    "\n\nCompiled kernels are kept between runs in PARHELION_CACHE_DIR, else parhelion/ below "
    "XDG_CACHE_HOME, else ~/.cache/parhelion: at most PARHELION_CACHE_SIZE megabytes (512), the "
    "longest unused go first. It may be deleted at any time. They are compiled in a temporary "
    "folder (TMPDIR, else /tmp), which is removed at the end.";

} // namespace parhelion
