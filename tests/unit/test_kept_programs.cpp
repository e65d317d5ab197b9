// What is kept of compiled programs: the cache's bound, and files of the driver as bytes.
#include "host/cl/packed_files.h"
#include "host/cl/program_cache.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>

using namespace parhelion;
namespace fs = std::filesystem;

namespace {

class Folder {
public:
    Folder() { fs::create_directories(path); }
    Folder(const Folder&) = delete;
    ~Folder() { fs::remove_all(path); }
    const fs::path path =
        fs::temp_directory_path() / fmt::format("parhelion-kept-programs-{}", getpid());
};

std::vector<unsigned char> packed(const std::string& path, const std::string& contents) {
    const std::uint64_t sizes[] = {path.size(), contents.size()};
    std::vector<unsigned char> bytes(sizeof sizes);
    std::memcpy(bytes.data(), sizes, sizeof sizes);
    bytes.insert(bytes.end(), path.begin(), path.end());
    bytes.insert(bytes.end(), contents.begin(), contents.end());
    return bytes;
}

} // namespace

TEST_CASE("Program cache: what was not asked for the longest makes room", "[unit]") {
    Folder folder;
    const std::vector<unsigned char> binary(1000, 'b');
    ProgramCache cache(folder.path, 2500);
    const auto now = fs::file_time_type::clock::now();
    for (int i = 0; i < 2; i++) {
        CHECK(cache.store(fmt::format("{}", i), binary).empty());
        fs::last_write_time(cache.path(fmt::format("{}", i)), now - std::chrono::hours(2 - i));
    }
    CHECK(cache.load("0").binary == binary); // the older one, but asked for now
    CHECK(cache.store("2", binary).empty());
    CHECK(cache.contains("0"));
    CHECK_FALSE(cache.contains("1"));
    CHECK(cache.contains("2"));
    CHECK_FALSE(cache.store("large", std::vector<unsigned char>(3000)).empty());
    CHECK_FALSE(cache.contains("large"));
    CHECK(cache.contains("2"));
    // Another's files are left alone, whatever their size.
    std::ofstream(folder.path / "notes.txt") << std::string(10000, 'n');
    CHECK(cache.store("3", binary).empty());
    CHECK(fs::exists(folder.path / "notes.txt"));
    CHECK(cache.contains("3"));
}

TEST_CASE("Program cache: a spare folder takes what its own does not", "[unit]") {
    Folder folder;
    const std::vector<unsigned char> binary(1000, 'b');
    std::ofstream(folder.path / "file") << "in the way";
    ProgramCache cache = ProgramCache(folder.path / "file").with_spare(folder.path / "spare");
    CHECK(cache.open_folder() == folder.path / "spare");
    CHECK(cache.store("key", binary).find("Not a directory") != std::string::npos);
    CHECK(cache.load("key").binary == binary);
    CHECK_FALSE(cache.load("another key").binary);
}

TEST_CASE("Packed files: none, some, damaged ones, and places outside", "[unit]") {
    Folder folder;
    fs::create_directories(folder.path / "in/a/b");
    std::ofstream(folder.path / "in/a/b/one.so") << std::string("o\0e", 3);
    std::ofstream(folder.path / "in/a/empty") << "";
    const std::vector<std::string> files = {"a/b/one.so", "a/empty"};
    auto bytes = pack_files(folder.path / "in", files);
    REQUIRE(bytes);
    CHECK(unpack_files(*bytes, folder.path / "out") == files);
    CHECK(pack_files(folder.path / "out", files) == bytes);
    CHECK(unpack_files({}, folder.path / "out") == std::vector<std::string>{});
    CHECK_FALSE(pack_files(folder.path / "in", {"a/none"}));
    for (std::size_t size = 1; size < bytes->size(); size++) {
        if (size == bytes->size() - files[1].size() - 16) continue; // the first file, whole
        CAPTURE(size);
        CHECK_FALSE(unpack_files({bytes->begin(), bytes->begin() + static_cast<long>(size)},
                                 folder.path / "cut"));
    }
    CHECK_FALSE(fs::exists(folder.path / "cut"));
    CHECK(unpack_files(packed("file", "text"), folder.path / "out"));
    for (const char* outside : {"../out.so", "a/../../out.so", "/tmp/out.so", ""})
        CHECK_FALSE(unpack_files(packed(outside, "text"), folder.path / "out"));
}
