// Compiled programs kept on disk between runs.
#include "host/cl/program_cache.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string_view>

namespace parhelion {
namespace {

constexpr std::string_view magic = "parhelion program 1\n";

/// FNV-1a, 64 bits: names a file and notices damage; equality of keys is checked on the keys
/// themselves.
std::uint64_t hash_bytes(const void* data, std::size_t size) {
    std::uint64_t h = 0xcbf29ce484222325u;
    for (std::size_t i = 0; i < size; i++)
        h = (h ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3u;
    return h;
}

struct Header {
    std::uint64_t key_size, binary_size, binary_hash;
};

std::optional<std::string> read_file(const std::filesystem::path& path) {
    std::error_code error; // a folder of that name, say
    std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) return std::nullopt;
    std::string text(size, '\0');
    std::ifstream in(path, std::ios::binary);
    if (!in.read(text.data(), static_cast<std::streamsize>(size))) return std::nullopt;
    return text;
}

} // namespace

ProgramCache ProgramCache::standard() {
    if (const char* own = std::getenv("PARHELION_CACHE_DIR")) return ProgramCache(own);
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
        return ProgramCache(std::filesystem::path(cache) / "parhelion");
    if (const char* home = std::getenv("HOME"); home && *home)
        return ProgramCache(std::filesystem::path(home) / ".cache" / "parhelion");
    return ProgramCache({});
}

std::filesystem::path ProgramCache::path(const std::string& key) const {
    return folder_ / fmt::format("{:016x}.program", hash_bytes(key.data(), key.size()));
}

std::optional<std::vector<unsigned char>> ProgramCache::load(const std::string& key) const {
    if (folder_.empty()) return std::nullopt;
    std::optional<std::string> text = read_file(path(key));
    if (!text || text->size() < magic.size() + sizeof(Header) || !text->starts_with(magic))
        return std::nullopt;
    Header header;
    text->copy(reinterpret_cast<char*>(&header), sizeof header, magic.size());
    std::string_view rest = std::string_view(*text).substr(magic.size() + sizeof header);
    if (header.key_size != key.size() || !rest.starts_with(key)) return std::nullopt;
    rest.remove_prefix(key.size());
    if (header.binary_size != rest.size() ||
        header.binary_hash != hash_bytes(rest.data(), rest.size()))
        return std::nullopt;
    return std::vector<unsigned char>(rest.begin(), rest.end());
}

void ProgramCache::store(const std::string& key, const std::vector<unsigned char>& binary) const {
    if (folder_.empty()) return;
    std::error_code ignored;
    std::filesystem::create_directories(folder_, ignored);
    std::filesystem::path target = path(key);
    std::filesystem::path temporary = target.string() + fmt::format(".{}.part", getpid());
    Header header{key.size(), binary.size(), hash_bytes(binary.data(), binary.size())};
    std::ofstream out(temporary, std::ios::binary);
    out.write(magic.data(), magic.size());
    out.write(reinterpret_cast<const char*>(&header), sizeof header);
    out.write(key.data(), static_cast<std::streamsize>(key.size()));
    out.write(reinterpret_cast<const char*>(binary.data()),
              static_cast<std::streamsize>(binary.size()));
    out.close();
    if (out) std::filesystem::rename(temporary, target, ignored);
    if (!out || ignored) std::filesystem::remove(temporary, ignored);
}

} // namespace parhelion
