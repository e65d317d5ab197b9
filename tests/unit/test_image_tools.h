// What the image tests share: a folder that goes away, and the place of the optional data.
#pragma once

#include "host/error.h"
#include "host/image/image.h"
#include "tests/support/skip.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>
#include <vector>

namespace image_test {

namespace fs = std::filesystem;

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "parhelion-test-XXXXXX").string();
        REQUIRE(::mkdtemp(name.data()) != nullptr);
        path_ = name;
    }
    ~TemporaryFolder() { fs::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string file(const std::string& name) const { return (path_ / name).string(); }
    std::string name() const { return path_.string(); }

    /// Number of entries, hidden ones too.
    std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
    }

private:
    fs::path path_;
};

inline std::vector<char> read_bytes(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    REQUIRE(stream);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const std::string& file, const std::vector<char>& bytes) {
    std::ofstream stream(file, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    REQUIRE(stream);
}

/// A folder of the shared data, or "" (having said so) where there is none.
inline std::string data_folder(const std::string& below) {
    const char* root = std::getenv("PARHELION_DATA");
    if (!root || !*root) {
        parhelion::test::skip("PARHELION_DATA is not set");
        return "";
    }
    const fs::path folder = fs::path(root) / below;
    if (!fs::is_directory(folder)) {
        parhelion::test::skip("no folder " + folder.string());
        return "";
    }
    return folder.string();
}

/// All files below a folder with this extension, sorted.
inline std::vector<std::string> files_below(const std::string& folder,
                                            const std::string& extension) {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().extension() == extension)
            files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

/// The message of the error a call throws; fails the test where it throws none, or one that is not
/// a single line.
template<class Error = parhelion::InputError, class Call>
std::string refusal(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        const std::string message = error.what();
        CHECK(!message.empty());
        CHECK(message.find('\n') == std::string::npos);
        return message;
    }
    FAIL("nothing was refused");
    return "";
}

} // namespace image_test
