// Compiled programs kept on disk between runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace parhelion {

/// What a cache has for a key, and one line for the user, or none, where that is worth knowing.
struct CachedProgram {
    std::optional<std::vector<unsigned char>> binary;
    std::string note{};
};

/// A folder of program binaries, which any number of processes may use at once. A file holds its
/// whole key beside the binary, so two keys with one hash are told apart, and a checksum. One that
/// is damaged is set aside, counts as absent and is made again.
class ProgramCache {
public:
    static constexpr std::uint64_t usual_bytes = std::uint64_t{512} << 20;

    /// PARHELION_CACHE_DIR, else parhelion/ below XDG_CACHE_HOME, else ~/.cache/parhelion; no
    /// folder, no cache. It keeps to PARHELION_CACHE_SIZE megabytes. Throws InputError where that
    /// is no such number.
    static ProgramCache standard();
    /// `most_bytes`: of all files together; those that were not asked for the longest go first.
    explicit ProgramCache(std::filesystem::path folder, std::uint64_t most_bytes = usual_bytes)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    /// The same, which keeps in `spare` what its own folder does not take.
    ProgramCache with_spare(std::filesystem::path spare) const;

    CachedProgram load(const std::string& key) const;
    /// Whether there is something to load. It may turn out to be damaged.
    bool contains(const std::string& key) const;
    /// Nothing, or one line that says why the binary is not kept for the next run.
    std::string store(const std::string& key, const std::vector<unsigned char>& binary) const;

    /// Where the program of this key is kept.
    std::filesystem::path path(const std::string& key) const;
    const std::filesystem::path& folder() const { return folder_; }
    /// What is in its folder, and how much may be.
    struct Use {
        std::size_t programs = 0;
        std::uint64_t bytes = 0, most_bytes = 0;
    };
    Use use() const;
    /// The folder that a program would be stored in now: its own, or the spare one.
    std::filesystem::path open_folder() const;

private:
    std::string store_below(const std::filesystem::path& folder, const std::string& key,
                            const std::vector<unsigned char>& binary) const;

    std::filesystem::path folder_, spare_;
    std::uint64_t most_bytes_;
};

} // namespace parhelion
