// Files of a folder as one run of bytes, and back: for each the sizes of its path and of its
// contents, 8 bytes each, then both.
#include "host/cl/packed_files.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

namespace parhelion {
namespace fs = std::filesystem;
namespace {

struct Sizes {
    std::uint64_t path, contents;
};

void append(std::vector<unsigned char>& bytes, const void* data, std::size_t size) {
    const auto* first = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

/// Takes what is at the front of `rest`; nothing where there is less.
std::optional<std::string_view> take(std::string_view& rest, std::uint64_t size) {
    if (size > rest.size()) return std::nullopt;
    std::string_view taken = rest.substr(0, size);
    rest.remove_prefix(size);
    return taken;
}

bool stays_below(const fs::path& path) {
    if (path.empty() || path.is_absolute()) return false;
    for (const fs::path& part : path)
        if (part == "..") return false;
    return true;
}

bool write_new(const fs::path& file, std::string_view contents) {
    std::error_code error;
    if (fs::exists(file, error)) return true; // the driver may be using it
    fs::create_directories(file.parent_path(), error);
    std::ofstream out(file, std::ios::binary);
    out.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    out.close();
    fs::permissions(file, fs::perms::owner_all, error);
    return out.good() && !error;
}

using Unpacked = std::vector<std::pair<std::string, std::string_view>>;

std::optional<Unpacked> read_all(std::string_view rest) {
    Unpacked files;
    while (!rest.empty()) {
        Sizes sizes{};
        auto header = take(rest, sizeof sizes);
        if (!header) return std::nullopt;
        std::memcpy(&sizes, header->data(), sizeof sizes);
        auto path = take(rest, sizes.path), contents = take(rest, sizes.contents);
        if (!path || !contents || !stays_below(*path)) return std::nullopt;
        files.emplace_back(*path, *contents);
    }
    return files;
}

} // namespace

std::optional<std::vector<unsigned char>> pack_files(const fs::path& root,
                                                     const std::vector<std::string>& files) {
    std::vector<unsigned char> bytes;
    for (const std::string& path : files) {
        std::ifstream in(root / path, std::ios::binary);
        std::string contents(std::istreambuf_iterator<char>(in), {});
        if (!in) return std::nullopt;
        Sizes sizes{path.size(), contents.size()};
        append(bytes, &sizes, sizeof sizes);
        append(bytes, path.data(), path.size());
        append(bytes, contents.data(), contents.size());
    }
    return bytes;
}

std::optional<std::vector<std::string>> unpack_files(const std::vector<unsigned char>& bytes,
                                                     const fs::path& root) {
    auto files = read_all({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!files) return std::nullopt;
    std::vector<std::string> paths;
    for (const auto& [path, contents] : *files) {
        if (!write_new(root / path, contents)) return std::nullopt;
        paths.push_back(path);
    }
    return paths;
}

} // namespace parhelion
