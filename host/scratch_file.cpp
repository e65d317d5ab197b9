// A file for what is too large for memory.
#include "host/scratch_file.h"

#include "host/error.h"
#include "host/read_at.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace parhelion {
namespace {

/// Without a name from the beginning, or, on a file system that has no such files, from then on.
int open_nameless(const std::string& folder) {
    const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_EXCL | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor >= 0) return descriptor;
    std::string name = folder + "/.parhelion-XXXXXX";
    const int named = ::mkostemp(name.data(), O_CLOEXEC);
    if (named >= 0) ::unlink(name.c_str());
    return named;
}

} // namespace

ScratchFile::ScratchFile(std::string folder)
    : folder_(std::move(folder)), descriptor_(open_nameless(folder_)) {
    if (descriptor_ < 0) fail("cannot be made", errno);
}

ScratchFile::~ScratchFile() { ::close(descriptor_); }

void ScratchFile::fail(const char* what, int error) const {
    throw OutputError(fmt::format("{}: a scratch file in this folder {}: {}", folder_, what,
                                  error == 0 ? "it ends too early" : std::strerror(error)));
}

std::uint64_t ScratchFile::append(const void* bytes, std::size_t count) {
    const std::uint64_t begin = end_.fetch_add(count);
    const auto* from = static_cast<const char*>(bytes);
    for (std::uint64_t at = begin; count > 0;) {
        const ssize_t put = pwrite(descriptor_, from, count, static_cast<off_t>(at));
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) fail("cannot be written", errno);
        from += put, at += static_cast<std::uint64_t>(put), count -= static_cast<std::size_t>(put);
    }
    return begin;
}

void ScratchFile::read(std::uint64_t at, void* bytes, std::size_t count) const {
    if (!read_at(descriptor_, at, bytes, count)) fail("cannot be read", errno);
}

std::uint64_t free_disk_bytes(const std::string& folder) {
    std::error_code error;
    const auto space = std::filesystem::space(folder, error);
    return error ? 0 : space.available;
}

} // namespace parhelion
