// Compiled programs kept on disk between runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace parhelion {

/// A folder of program binaries. A file holds its whole key beside the binary, so two keys with one
/// hash are told apart; a file that is damaged or cannot be read counts as absent, and one that
/// cannot be written is done without.
class ProgramCache {
public:
    /// PARHELION_CACHE_DIR, else parhelion/ below XDG_CACHE_HOME, else ~/.cache/parhelion. No
    /// folder, no cache.
    static ProgramCache standard();
    explicit ProgramCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    std::optional<std::vector<unsigned char>> load(const std::string& key) const;
    void store(const std::string& key, const std::vector<unsigned char>& binary) const;
    /// Where the program of this key is kept.
    std::filesystem::path path(const std::string& key) const;

private:
    std::filesystem::path folder_;
};

} // namespace parhelion
