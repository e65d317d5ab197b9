// Mitsuba's own compressed mesh files (.serialized, versions 3 and 4).
#include "host/scene/mesh_serialized.h"

#include "host/scene/file_finder.h"
#include "host/scene/text.h"

#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace parhelion {

namespace {

static_assert(std::endian::native == std::endian::little, "the format is little endian");

constexpr std::size_t max_file_bytes = std::size_t(4) << 30;
constexpr std::uint64_t max_items = std::uint64_t(1) << 27; ///< zeros deflate a thousandfold
constexpr std::uint16_t magic = 0x041c;

enum Flag : std::uint32_t {
    has_normals = 0x0001,
    has_uvs = 0x0002,
    has_colors = 0x0008,
    face_normals = 0x0010,
    single_precision = 0x1000,
    double_precision = 0x2000,
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

template<int N>
std::vector<glm::vec<N, double>> read_vectors(InflateStream& stream, std::uint64_t count,
                                              bool doubles, const SourceLocation& place) {
    std::vector<glm::vec<N, double>> result;
    int filled = 0;
    const auto take = [&](double v) {
        if (!std::isfinite(v)) refuse(place, "a vertex holds a number that is not finite");
        if (filled == 0) result.emplace_back(0.0);
        result.back()[filled] = v;
        filled = (filled + 1) % N;
    };
    if (doubles)
        stream.numbers<double>(count * N, take);
    else
        stream.numbers<float>(count * N, take);
    return result;
}

void read_triangles(InflateStream& stream, std::uint64_t count, MeshData& mesh,
                    const SourceLocation& place) {
    int filled = 0;
    stream.numbers<std::uint32_t>(count * 3, [&](std::uint32_t index) {
        if (index >= mesh.positions.size())
            refuse(place, "a triangle uses vertex " + std::to_string(index) + " of " +
                              std::to_string(mesh.positions.size()));
        if (filled == 0) mesh.triangles.emplace_back(0u);
        mesh.triangles.back()[filled] = index;
        filled = (filled + 1) % 3;
    });
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
    InflateStream stream(file.substr(start + 4), file_place);
    const auto flags = stream.value<std::uint32_t>();
    if (version == 4)
        while (stream.value<char>() != '\0') {
        } // the mesh's name
    const auto vertices = stream.value<std::uint64_t>();
    const auto triangles = stream.value<std::uint64_t>();
    if (vertices > max_items || triangles > max_items)
        refuse(file_place, "the mesh claims " + std::to_string(vertices) + " vertices and " +
                               std::to_string(triangles) + " triangles");
    const bool doubles = (flags & double_precision) != 0;
    if (doubles == ((flags & single_precision) != 0))
        refuse(file_place, "the header must say single or double precision");
    SerializedMesh result;
    MeshData& mesh = result.mesh;
    mesh.positions = read_vectors<3>(stream, vertices, doubles, file_place);
    if (flags & has_normals) mesh.normals = read_vectors<3>(stream, vertices, doubles, file_place);
    if (flags & has_uvs) mesh.uvs = read_vectors<2>(stream, vertices, doubles, file_place);
    if (flags & has_colors) {
        read_vectors<3>(stream, vertices, doubles, file_place);
        mesh.notes.push_back(file_place.file + ": vertex colours are not used");
    }
    read_triangles(stream, triangles, mesh, file_place);
    result.face_normals = (flags & face_normals) != 0;
    return result;
}

SerializedMesh load_serialized(const std::filesystem::path& path, std::int64_t shape_index,
                               const SourceLocation& place) {
    return parse_serialized(read_whole_file(path, place, max_file_bytes), shape_index,
                            path.string());
}

} // namespace parhelion
