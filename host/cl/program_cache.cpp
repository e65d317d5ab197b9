// Compiled programs kept on disk between runs.
#include "host/cl/program_cache.h"

#include "host/cl/folder_trial.h"
#include "host/cl/program_file.h"
#include "host/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>

namespace parhelion {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t megabyte = 1u << 20;
constexpr const char* size_variable = "PARHELION_CACHE_SIZE";
constexpr std::uint64_t most_megabytes = 1'000'000;

fs::path standard_folder() {
    if (const char* own = std::getenv("PARHELION_CACHE_DIR"); own && *own) return own;
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        return fs::path(cache) / "parhelion";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".cache" / "parhelion";
    return {};
}

std::uint64_t standard_bytes() {
    const char* given = std::getenv(size_variable);
    if (!given || !*given) return ProgramCache::usual_bytes;
    std::uint64_t megabytes = 0;
    const char* end = given + std::strlen(given);
    auto [read, error] = std::from_chars(given, end, megabytes);
    if (error != std::errc() || read != end || megabytes > most_megabytes)
        throw InputError(fmt::format("{} is '{}': accepted are whole megabytes from 0 to {}",
                                     size_variable, given, most_megabytes));
    return megabytes * megabyte;
}

struct File {
    fs::file_time_type asked_for;
    std::uint64_t bytes;
    fs::path path;
};

/// Those of a cache, the one not asked for the longest first.
std::vector<File> files_of(const fs::path& folder) {
    std::vector<File> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code gone; // another process may have removed it
        if (!is_program_file(entry->path().filename()) || !entry->is_regular_file(gone)) continue;
        File file{entry->last_write_time(gone), entry->file_size(gone), entry->path()};
        if (!gone) files.push_back(std::move(file));
    }
    std::sort(files.begin(), files.end(),
              [](const File& a, const File& b) { return a.asked_for < b.asked_for; });
    return files;
}

/// All but `kept` go where there are more than `most_bytes`, the longest unused first.
void keep_within(std::uint64_t most_bytes, const fs::path& folder, const fs::path& kept) {
    std::vector<File> files = files_of(folder);
    std::uint64_t bytes = 0;
    for (const File& file : files)
        bytes += file.bytes;
    for (const File& file : files) {
        if (bytes <= most_bytes) return;
        if (file.path == kept) continue;
        std::error_code ignored;
        fs::remove(file.path, ignored);
        bytes -= file.bytes;
    }
}

} // namespace

ProgramCache ProgramCache::standard() { return ProgramCache(standard_folder(), standard_bytes()); }

ProgramCache ProgramCache::with_spare(fs::path spare) const {
    ProgramCache cache = *this;
    cache.spare_ = std::move(spare);
    return cache;
}

fs::path ProgramCache::path(const std::string& key) const {
    return folder_ / program_file_name(key);
}

CachedProgram ProgramCache::load(const std::string& key) const {
    CachedProgram found;
    if (!folder_.empty()) found = read_program_file(path(key), key);
    if (!found.binary && !spare_.empty())
        found.binary = read_program_file(spare_ / program_file_name(key), key).binary;
    return found;
}

bool ProgramCache::contains(const std::string& key) const {
    std::error_code ignored;
    return !folder_.empty() && fs::is_regular_file(path(key), ignored);
}

fs::path ProgramCache::open_folder() const {
    constexpr std::uint64_t a_program = 4 * megabyte;
    return !folder_.empty() && most_bytes_ > 0 && why_not_writable(folder_, a_program).empty()
               ? folder_
               : spare_;
}

ProgramCache::Use ProgramCache::use() const {
    Use use{.most_bytes = most_bytes_};
    if (folder_.empty()) return use;
    for (const File& file : files_of(folder_)) {
        use.programs++;
        use.bytes += file.bytes;
    }
    return use;
}

std::string ProgramCache::store_below(const fs::path& folder, const std::string& key,
                                      const std::vector<unsigned char>& binary) const {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return error.message();
    fs::path file = folder / program_file_name(key);
    std::string reason = write_program_file(file, key, binary);
    if (reason.empty() && folder == folder_) keep_within(most_bytes_, folder, file);
    return reason;
}

std::string ProgramCache::store(const std::string& key,
                                const std::vector<unsigned char>& binary) const {
    std::string reason;
    if (folder_.empty())
        reason = "no cache folder: PARHELION_CACHE_DIR, XDG_CACHE_HOME and HOME are not set";
    else if (binary.size() + key.size() > most_bytes_)
        reason = fmt::format("{} allows {} MB", size_variable, most_bytes_ / megabyte);
    else if (reason = store_below(folder_, key, binary); !reason.empty())
        reason =
            fmt::format("the cache folder {} cannot be written ({})", folder_.string(), reason);
    if (reason.empty()) return {};
    if (!spare_.empty()) store_below(spare_, key, binary);
    return reason + ": kernels are compiled again next time";
}

} // namespace parhelion
