// Whether a file is what it was when it was read.
#include "host/file_stamp.h"

#include <chrono>
#include <sys/stat.h>

namespace parhelion {
namespace {

/// Longer than any file system's tick but FAT's.
constexpr std::chrono::milliseconds just_now{100};

bool is_just_now(const timespec& time) {
    using namespace std::chrono;
    const auto since_epoch = seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
    return system_clock::now().time_since_epoch() - since_epoch < just_now;
}

} // namespace

std::optional<FileStamp> file_stamp(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0 || is_just_now(status.st_mtim)) return std::nullopt;
    return FileStamp{status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
                     status.st_mtim.tv_nsec};
}

} // namespace parhelion
