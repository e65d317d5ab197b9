// Reading from a place of a file.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>

#include <unistd.h>

namespace parhelion {

/// All of `count` bytes from `at` on, however many the system reads at once; whether they were
/// there to be read. If not, errno says why, 0 at the end of the file.
inline bool read_at(int descriptor, std::uint64_t at, void* bytes, std::size_t count) {
    auto* to = static_cast<char*>(bytes);
    while (count > 0) {
        errno = 0;
        const ssize_t got = pread(descriptor, to, count, static_cast<off_t>(at));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        to += got, at += static_cast<std::uint64_t>(got), count -= static_cast<std::size_t>(got);
    }
    return true;
}

} // namespace parhelion
