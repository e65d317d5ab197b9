// Can a folder be written to?
#include "host/cl/folder_trial.h"

#include "host/cl/open_file.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace parhelion {
namespace {

/// A new file that has no name any more.
OpenFile nameless_file(const std::filesystem::path& folder) {
    std::string name = (folder / ".parhelion-trial-XXXXXX").string();
    OpenFile file(mkostemp(name.data(), O_CLOEXEC));
    if (file) unlink(name.c_str());
    return file;
}

/// 0, or the error's number.
int take_space(const OpenFile& file, std::uint64_t bytes) {
    if (fallocate(file.number(), 0, 0, static_cast<off_t>(bytes)) == 0) return 0;
    if (errno != EOPNOTSUPP) return errno;
    struct statvfs system {};
    if (fstatvfs(file.number(), &system) != 0) return errno;
    return system.f_bavail * system.f_frsize < bytes ? ENOSPC : 0;
}

} // namespace

std::string why_not_writable(const std::filesystem::path& folder, std::uint64_t bytes) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return error.message();
    OpenFile file = nameless_file(folder);
    if (!file) return std::strerror(errno);
    int number = take_space(file, bytes);
    return number == 0 ? "" : std::strerror(number);
}

bool may_hold_programs(const std::filesystem::path& folder) {
    struct statvfs system {};
    return statvfs(folder.c_str(), &system) == 0 && (system.f_flag & ST_NOEXEC) == 0;
}

} // namespace parhelion
