// Whether a file is what it was when it was read.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>

namespace parhelion {

/// Which file, how long, and when it was last written to: two that are the same are of the same
/// content, unless someone sets times by hand.
struct FileStamp {
    dev_t device = 0;
    ino_t number = 0;
    std::int64_t bytes = 0, seconds = 0, nanoseconds = 0;

    bool operator==(const FileStamp&) const = default;
};

/// Nothing where there is no such file, and of one that has been written to just now: it could be
/// again within the same tick of the file system's clock.
std::optional<FileStamp> file_stamp(const std::filesystem::path& file);

} // namespace parhelion
