// The seeds and finds of the fuzz targets: every one is read, or refused with one line.
#include "targets.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    if (fs::is_directory(folder))
        for (const auto& entry : fs::directory_iterator(folder))
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Returns how many inputs there were.
std::size_t replay(const std::string& name, parhelion::fuzz::Target& target) {
    std::size_t count = 0;
    for (const char* const folder : {"seeds", "finds"})
        for (const fs::path& file :
             files_in(fs::path(PARHELION_SOURCE_DIR "/tests/fuzz") / folder / name)) {
            const std::vector<std::uint8_t> bytes = bytes_of(file);
            INFO(file);
            CHECK_NOTHROW(target(bytes.data(), bytes.size()));
            // Cut short: ends where nobody expects them.
            for (const std::size_t divisor : {2, 3, 5})
                CHECK_NOTHROW(target(bytes.data(), bytes.size() / divisor));
            ++count;
        }
    return count;
}

} // namespace

#define REPLAY(name)                                                                               \
    TEST_CASE("fuzz replay: " #name) { CHECK(replay(#name, parhelion::fuzz::fuzz_##name) > 0); }
FUZZ_TARGETS(REPLAY)
#undef REPLAY
