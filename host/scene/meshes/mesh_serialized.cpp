// Mitsuba's own compressed mesh files (.serialized, versions 3 and 4).
#include "host/scene/meshes/mesh_serialized.h"

#include "host/scene/file_finder.h"
#include "host/scene/meshes/mesh_builder.h"
#include "host/scene/text.h"

#include <zlib.h>

#include <array>
#include <bit>
#include <cstring>

namespace parhelion {

namespace {

static_assert(std::endian::native == std::endian::little, "the format is little endian");

constexpr std::size_t max_file_bytes = std::size_t(4) << 30;

/// How much more than its compressed bytes a mesh may hold. Meshes deflate to a seventh at best (a
/// tenth where they are made to), zeros to a thousandth; small ones may do as they like.
constexpr std::uint64_t largest_ratio = 64, always_accepted = std::uint64_t(16) << 20;
constexpr std::uint16_t magic = 0x041c;

enum Flag : std::uint32_t {
    has_normals = 0x0001,
    has_uvs = 0x0002,
    has_colors = 0x0008,
    face_normals = 0x0010,
    single_precision = 0x1000,
    double_precision = 0x2000,
    known_flags = 0x301b,
};

/// Inflates a part of a file piece by piece, so that sizes in a damaged header cost no memory
/// before the data is really there.
class InflateStream {
public:
    InflateStream(std::string_view compressed, const SourceLocation& place) : place_(place) {
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data()));
        rest_ = compressed.size();
        if (inflateInit(&stream_) != Z_OK) refuse(place_, "zlib cannot start");
    }
    ~InflateStream() { inflateEnd(&stream_); }
    InflateStream(const InflateStream&) = delete;
    InflateStream& operator=(const InflateStream&) = delete;

    void read(void* target, std::size_t bytes) {
        auto* out = static_cast<Bytef*>(target);
        while (bytes > 0) {
            constexpr std::size_t chunk = std::size_t(1) << 30;
            if (stream_.avail_in == 0) {
                stream_.avail_in = static_cast<uInt>(std::min(rest_, chunk));
                rest_ -= stream_.avail_in;
            }
            stream_.next_out = out;
            stream_.avail_out = static_cast<uInt>(std::min(bytes, chunk));
            const std::size_t before = stream_.avail_out;
            const int status = inflate(&stream_, Z_NO_FLUSH);
            const std::size_t written = before - stream_.avail_out;
            if (written == 0 && status != Z_OK)
                refuse(place_, "the compressed data is damaged or ends too early");
            out += written;
            bytes -= written;
        }
    }

    /// Whether the compressed data goes on.
    bool has_more() {
        Bytef next;
        stream_.next_out = &next;
        stream_.avail_out = 1;
        return inflate(&stream_, Z_NO_FLUSH) >= Z_OK && stream_.avail_out == 0;
    }

    template<typename T>
    T value() {
        T result{};
        read(&result, sizeof result);
        return result;
    }

    /// `count` numbers of type T as doubles, handed to `take` one by one.
    template<typename T, typename Take>
    void numbers(std::uint64_t count, Take take) {
        std::vector<T> block;
        while (count > 0) {
            block.resize(static_cast<std::size_t>(std::min<std::uint64_t>(count, 3 << 14)));
            read(block.data(), block.size() * sizeof(T));
            for (const T v : block)
                take(v);
            count -= block.size();
        }
    }

private:
    const SourceLocation& place_;
    z_stream stream_{};
    std::size_t rest_ = 0;
};

template<typename T>
T read_at(std::string_view file, std::size_t offset, const SourceLocation& place) {
    if (offset > file.size() || file.size() - offset < sizeof(T))
        refuse(place, "the file ends too early");
    T value;
    std::memcpy(&value, file.data() + offset, sizeof value);
    return value;
}

/// Where a mesh starts, from the table of offsets at the end of the file.
std::size_t mesh_offset(std::string_view file, std::int64_t index, std::uint16_t version,
                        const SourceLocation& place) {
    if (index == 0) return 0;
    if (file.size() < sizeof(std::uint32_t)) refuse(place, "the file ends too early");
    const std::size_t table_end = file.size() - sizeof(std::uint32_t);
    const auto count = read_at<std::uint32_t>(file, table_end, place);
    if (index >= count)
        refuse(place, "shape_index " + std::to_string(index) + " is out of range: the file holds " +
                          std::to_string(count) + " meshes");
    const std::size_t width = version == 4 ? sizeof(std::uint64_t) : sizeof(std::uint32_t);
    const std::size_t back = width * (count - static_cast<std::size_t>(index));
    if (back > table_end) refuse(place, "the table of meshes is damaged");
    return version == 4 ? read_at<std::uint64_t>(file, table_end - back, place)
                        : read_at<std::uint32_t>(file, table_end - back, place);
}

/// What stands before the numbers of a mesh.
struct MeshHeader {
    std::uint32_t flags = 0;
    std::uint64_t vertices = 0, triangles = 0;

    bool has(Flag flag) const { return (flags & flag) != 0; }
    std::size_t real_size() const { return has(double_precision) ? 8 : 4; }

    /// What follows the header, infinite rather than too much for an integer.
    double bytes() const {
        const int reals =
            3 + (has(has_normals) ? 3 : 0) + (has(has_uvs) ? 2 : 0) + (has(has_colors) ? 3 : 0);
        return static_cast<double>(vertices) * static_cast<double>(real_size()) * reals +
               static_cast<double>(triangles) * 12.0;
    }
};

MeshHeader read_header(InflateStream& stream, std::uint16_t version, std::size_t compressed,
                       const SourceLocation& place) {
    MeshHeader header;
    header.flags = stream.value<std::uint32_t>();
    if (version == 4)
        while (stream.value<char>() != '\0') {
        } // the mesh's name
    header.vertices = stream.value<std::uint64_t>();
    header.triangles = stream.value<std::uint64_t>();
    if (header.has(double_precision) && header.has(single_precision))
        refuse(place, "the header says both single and double precision (accepted: one of them, or "
                      "none, which is single)");
    if (header.bytes() > static_cast<double>(largest_ratio * compressed + always_accepted))
        refuse(place, "the mesh claims " + std::to_string(header.vertices) + " vertices and " +
                          std::to_string(header.triangles) + " triangles in " +
                          std::to_string(compressed) + " compressed bytes (accepted: " +
                          std::to_string(largest_ratio) + " times the bytes)");
    return header;
}

/// `count` vectors, each handed to `take`.
template<int N, typename Take>
void read_vectors(InflateStream& stream, const MeshHeader& header, Take take) {
    glm::vec<N, double> vector;
    int filled = 0;
    const auto add = [&](double v) {
        vector[filled] = v;
        filled = (filled + 1) % N;
        if (filled == 0) take(vector);
    };
    if (header.has(double_precision))
        stream.numbers<double>(header.vertices * N, add);
    else
        stream.numbers<float>(header.vertices * N, add);
}

void read_mesh(InflateStream& stream, const MeshHeader& header, MeshBuilder& builder,
               const SourceLocation& place) {
    MeshData& mesh = builder.mesh;
    mesh.positions.reserve(header.vertices);
    read_vectors<3>(stream, header, [&](const glm::dvec3& p) { mesh.positions.push_back(p); });
    if (header.has(has_normals)) {
        mesh.normals.reserve(header.vertices);
        read_vectors<3>(stream, header,
                        [&](const glm::dvec3& n) { mesh.normals.push_back(normal_in_file(n)); });
    }
    if (header.has(has_uvs)) {
        mesh.uvs.reserve(header.vertices);
        read_vectors<2>(stream, header, [&](const glm::dvec2& uv) { mesh.uvs.push_back(uv); });
    }
    if (header.has(has_colors)) {
        read_vectors<3>(stream, header, [](const glm::dvec3&) {});
        builder.note("vertex colours are not used");
    }
    mesh.triangles.reserve(header.triangles);
    std::array<std::uint32_t, 3> triangle{};
    std::size_t filled = 0;
    stream.numbers<std::uint32_t>(header.triangles * 3, [&](std::uint32_t index) {
        triangle[filled] = index;
        filled = (filled + 1) % 3;
        if (filled == 0) builder.add_face(triangle, place);
    });
}

/// What a file of another version may hold: said, since its numbers could stand elsewhere.
void note_unknown(const MeshHeader& header, InflateStream& stream, MeshBuilder& builder) {
    if ((header.flags & ~known_flags) != 0)
        builder.note("flags " + std::to_string(header.flags & ~known_flags) +
                     " of the mesh are not known and not used");
    if (stream.has_more()) builder.note("data after the last triangle is not used");
}

} // namespace

SerializedMesh parse_serialized(std::string_view file, std::int64_t shape_index,
                                const std::string& name) {
    const SourceLocation file_place{name, 0};
    if (read_at<std::uint16_t>(file, 0, file_place) != magic)
        refuse(file_place, "not a serialized mesh: the first two bytes are wrong");
    const auto version = read_at<std::uint16_t>(file, 2, file_place);
    if (version != 3 && version != 4)
        refuse(file_place, "serialized format version " + std::to_string(version) +
                               " is not supported (accepted: 3, 4)");
    const std::size_t start = mesh_offset(file, shape_index, version, file_place);
    if (read_at<std::uint16_t>(file, start, file_place) != magic || file.size() - start < 4)
        refuse(file_place, "the table of meshes is damaged");
    const std::string_view compressed = file.substr(start + 4);
    InflateStream stream(compressed, file_place);
    const MeshHeader header = read_header(stream, version, compressed.size(), file_place);
    MeshBuilder builder(name);
    read_mesh(stream, header, builder, file_place);
    note_unknown(header, stream, builder);
    return {std::move(builder).finish(), header.has(face_normals)};
}

SerializedMesh load_serialized(const std::filesystem::path& path, std::int64_t shape_index,
                               const SourceLocation& place) {
    return parse_serialized(read_whole_file(path, place, max_file_bytes), shape_index,
                            path.string());
}

} // namespace parhelion
