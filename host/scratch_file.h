// A file for what is too large for memory: it has no name, and goes with the process.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace parhelion {

class ScratchFile {
public:
    /// Empty, in that folder. Throws OutputError where none can be made.
    explicit ScratchFile(std::string folder);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    /// Where so many bytes are that were put behind all others, by several threads if need be.
    /// Throws OutputError.
    std::uint64_t append(const void* bytes, std::size_t count);
    /// Throws OutputError.
    void read(std::uint64_t at, void* bytes, std::size_t count) const;

    std::uint64_t bytes() const { return end_; }

private:
    [[noreturn]] void fail(const char* what, int error) const;

    std::string folder_;
    int descriptor_ = -1;
    std::atomic<std::uint64_t> end_ = 0;
};

/// Bytes that a file in that folder may still have; 0 where it cannot be found out.
std::uint64_t free_disk_bytes(const std::string& folder);

} // namespace parhelion
