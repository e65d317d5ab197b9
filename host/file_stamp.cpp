// Whether a file is what it was when it was read.
#include "host/file_stamp.h"

#include <sys/stat.h>

namespace parhelion {

std::optional<FileStamp> file_stamp(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return std::nullopt;
    return FileStamp{status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
                     status.st_mtim.tv_nsec};
}

} // namespace parhelion
