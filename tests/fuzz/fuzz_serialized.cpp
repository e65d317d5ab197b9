// Mitsuba's serialized meshes. Mutated bytes hardly ever inflate, so an input is also taken for the
// inflated content of a mesh, which is put behind the start of a file without compressing it.
#include "host/scene/meshes/mesh_serialized.h"
#include "property.h"
#include "targets.h"

#include <zlib.h>

namespace parhelion::fuzz {

namespace {

void append_number(std::string& bytes, std::uint32_t value, int count, bool big_endian) {
    for (int i = 0; i < count; ++i)
        bytes += static_cast<char>(value >> 8 * (big_endian ? count - 1 - i : i));
}

/// One stored block of a zlib stream (RFC 1950, RFC 1951 section 3.2.4).
std::string stored(std::string_view content) {
    const auto length = static_cast<std::uint32_t>(content.size());
    std::string bytes = "\x78\x01\x01";
    append_number(bytes, length, 2, false);
    append_number(bytes, ~length, 2, false);
    bytes += content;
    const auto* const begin = reinterpret_cast<const Bytef*>(content.data());
    append_number(bytes, static_cast<std::uint32_t>(adler32(1, begin, length)), 4, true);
    return bytes;
}

std::string mesh_of(std::string_view content, char version) {
    return std::string("\x1c\x04", 2) + version + '\0' + stored(content);
}

void read(std::string_view file, std::int64_t index) {
    check_mesh_data(parse_serialized(file, index, "mesh.serialized").mesh);
}

} // namespace

/// The first byte says how the rest is read: 0 to 2 a file, of which that mesh; 3 or 4 the content
/// of a mesh of that version of the format.
int fuzz_serialized(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t longest_block = 0xffff;
    if (size == 0 || data[0] > 4 || size > longest_block) return 0;
    const char kind = static_cast<char>(data[0]);
    const std::string_view rest = as_text(data + 1, size - 1);
    return answer_or_refusal([&] {
        if (kind < 3)
            read(rest, kind);
        else
            read(mesh_of(rest, kind), 0);
    });
}

} // namespace parhelion::fuzz
