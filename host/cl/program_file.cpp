// One file of the cache of compiled programs.
#include "host/cl/program_file.h"

#include "host/cl/open_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>

namespace parhelion {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view ending = ".program";
constexpr std::uint64_t most_bytes = std::uint64_t{256} << 20; ///< no program comes near

/// Of another version of this program, a file is no damage.
constexpr std::string_view magic_start = "parhelion program ", magic = "parhelion program 2\n";

struct Header {
    char name[magic.size()];
    char padding[4];
    std::uint64_t key_size, binary_size, hash; ///< hash: of key and binary
};

/// FNV-1a, 64 bits: names a file and notices damage; equality of keys is checked on the keys
/// themselves.
std::uint64_t hash_bytes(std::string_view bytes, std::uint64_t h = 0xcbf29ce484222325u) {
    for (char byte : bytes)
        h = (h ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
    return h;
}

std::string_view view_of(const std::vector<unsigned char>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Up to `size` bytes; fewer where the file ends or fails before.
std::string read_bytes(const OpenFile& file, std::size_t size) {
    std::string text(size, '\0');
    std::size_t have = 0;
    while (have < size) {
        ssize_t got = read(file.number(), text.data() + have, size - have);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        have += static_cast<std::size_t>(got);
    }
    text.resize(have);
    return text;
}

/// 0, or the error's number.
int write_bytes(const OpenFile& file, std::string_view bytes) {
    while (!bytes.empty()) {
        ssize_t put = write(file.number(), bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) return put < 0 ? errno : ENOSPC;
        bytes.remove_prefix(static_cast<std::size_t>(put));
    }
    return 0;
}

struct Content {
    CachedProgram found;
    const char* damage = nullptr; ///< what is wrong with the file
};

Content content_of(const OpenFile& file, const std::string& key) {
    struct stat status {};
    if (fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode)) return {{}, "no file"};
    const auto size = static_cast<std::uint64_t>(status.st_size);
    Header header{};
    std::string start = read_bytes(file, sizeof header);
    if (start.starts_with(magic_start) && !start.starts_with(magic)) return {};
    if (start.size() < sizeof header || !start.starts_with(magic)) return {{}, "no program"};
    std::memcpy(&header, start.data(), sizeof header);
    if (header.key_size > most_bytes || header.binary_size > most_bytes ||
        size != sizeof header + header.key_size + header.binary_size)
        return {{}, "not of the size it says"};
    std::string rest = read_bytes(file, header.key_size + header.binary_size);
    if (rest.size() != header.key_size + header.binary_size) return {{}, "cannot be read"};
    if (header.hash != hash_bytes(rest)) return {{}, "its checksum differs"};
    if (rest.compare(0, header.key_size, key) != 0) return {}; // another key of the same hash
    return {{std::vector<unsigned char>(rest.begin() + static_cast<std::ptrdiff_t>(header.key_size),
                                        rest.end())}};
}

std::string set_aside(const fs::path& file, const char* damage) {
    std::error_code error;
    fs::rename(file, file.string() + ".damaged", error);
    return fmt::format("{} is damaged ({}){}; its kernels are compiled again", file.string(),
                       damage, error ? "" : " and set aside");
}

} // namespace

std::string program_file_name(const std::string& key) {
    return fmt::format("{:016x}{}", hash_bytes(key), ending);
}

bool is_program_file(const std::string& name) { return name.find(ending) == 16; }

CachedProgram read_program_file(const fs::path& file, const std::string& key) {
    // A pipe of that name would wait for its other end.
    OpenFile in(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (!in && (errno == ENOENT || errno == ENOTDIR)) return {};
    if (!in) return {{}, fmt::format("{}: {}", file.string(), std::strerror(errno))};
    Content content = content_of(in, key);
    if (content.damage) content.found.note = set_aside(file, content.damage);
    if (content.found.binary) utimensat(AT_FDCWD, file.c_str(), nullptr, 0); // asked for just now
    return std::move(content.found);
}

std::string write_program_file(const fs::path& file, const std::string& key,
                               const std::vector<unsigned char>& binary) {
    Header header{{}, {}, key.size(), binary.size(), hash_bytes(view_of(binary), hash_bytes(key))};
    magic.copy(header.name, magic.size());
    // Nobody else's: a leftover of an earlier process of this number is written over.
    const std::string unfinished = fmt::format("{}.{}.{}", file.string(), getpid(), gettid());
    OpenFile out(open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!out) return std::strerror(errno);
    int error = 0;
    for (std::string_view part : {std::string_view(reinterpret_cast<char*>(&header), sizeof header),
                                  std::string_view(key), view_of(binary)})
        if (error == 0) error = write_bytes(out, part);
    std::error_code renaming(error, std::generic_category());
    if (error == 0) fs::rename(unfinished, file, renaming);
    if (renaming) unlink(unfinished.c_str());
    return renaming ? renaming.message() : "";
}

} // namespace parhelion
