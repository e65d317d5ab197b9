// Stanford PLY meshes, text and binary.
//
// Why a reader of our own: the one library Debian 12 has for it (Assimp 5.2.5) rounds to single
// precision, writes out of bounds on files made to do so, and takes misread data for a mesh.
#include "host/scene/mesh_ply.h"

#include "host/scene/file_finder.h"
#include "host/scene/ply_header.h"
#include "host/scene/text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

namespace parhelion {

namespace {

constexpr std::size_t max_file_bytes = std::size_t(4) << 30;

/// One number after the other from the data of a PLY file. Every PLY type fits a double exactly.
class PlyData {
public:
    PlyData(std::string_view file, const PlyHeader& header, const SourceLocation& place)
        : file_(file), offset_(header.data_start), encoding_(header.encoding), place_(place) {
        place_.line = encoding_ == PlyEncoding::ascii ? header.lines + 1 : 0;
    }

    double next(PlyType type) {
        return encoding_ == PlyEncoding::ascii ? next_word() : next_binary(type);
    }

    bool has_more() const {
        return encoding_ == PlyEncoding::ascii
                   ? file_.find_first_not_of(" \t\r\n", offset_) != file_.npos
                   : bytes_left() > 0;
    }
    std::size_t bytes_left() const { return file_.size() - offset_; }
    const SourceLocation& place() const { return place_; }

private:
    double next_word();
    double next_binary(PlyType type);

    template<typename T>
    static double as_double(const std::array<char, 8>& bytes) {
        T value;
        std::memcpy(&value, bytes.data(), sizeof value);
        return static_cast<double>(value);
    }

    std::string_view file_;
    std::size_t offset_;
    PlyEncoding encoding_;
    SourceLocation place_;
};

double PlyData::next_word() {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t start = std::min(file_.find_first_not_of(blanks, offset_), file_.size());
    place_.line +=
        static_cast<int>(std::count(file_.begin() + static_cast<std::ptrdiff_t>(offset_),
                                    file_.begin() + static_cast<std::ptrdiff_t>(start), '\n'));
    offset_ = std::min(file_.find_first_of(blanks, start), file_.size());
    if (start == offset_) refuse(place_, "the PLY file ends too early");
    const std::string_view word = file_.substr(start, offset_ - start);
    const std::optional<double> value = parse_number(word);
    if (!value) refuse(place_, in_quotes(word) + " is not a finite number");
    return *value;
}

double PlyData::next_binary(PlyType type) {
    const std::size_t size = ply_type_size(type);
    if (bytes_left() < size) refuse(place_, "the PLY file ends too early");
    std::array<char, 8> bytes{};
    std::memcpy(bytes.data(), file_.data() + offset_, size);
    offset_ += size;
    const bool little = encoding_ == PlyEncoding::little_endian;
    if (little != (std::endian::native == std::endian::little))
        std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    switch (type) {
    case PlyType::int8:
        return as_double<std::int8_t>(bytes);
    case PlyType::uint8:
        return as_double<std::uint8_t>(bytes);
    case PlyType::int16:
        return as_double<std::int16_t>(bytes);
    case PlyType::uint16:
        return as_double<std::uint16_t>(bytes);
    case PlyType::int32:
        return as_double<std::int32_t>(bytes);
    case PlyType::uint32:
        return as_double<std::uint32_t>(bytes);
    case PlyType::float32:
        return as_double<float>(bytes);
    case PlyType::float64:
        return as_double<double>(bytes);
    }
    refuse(place_, "unknown PLY type");
}

double next_finite(PlyData& data, PlyType type) {
    const double value = data.next(type);
    if (!std::isfinite(value))
        refuse(data.place(), "the PLY file holds a number that is not finite");
    return value;
}

std::uint32_t list_length(PlyData& data, const PlyProperty& property) {
    const double count = data.next(property.count_type);
    // An entry takes a byte or more, so a longer list cannot follow.
    if (!(count >= 0.0) || count != std::floor(count) ||
        count > static_cast<double>(data.bytes_left()))
        refuse(data.place(), "a list claims " + std::to_string(count) + " entries");
    return static_cast<std::uint32_t>(count);
}

void skip(PlyData& data, const PlyProperty& property) {
    const std::uint32_t count = property.list ? list_length(data, property) : 1;
    for (std::uint32_t i = 0; i < count; ++i)
        data.next(property.type);
}

/// Where a vertex property goes: 0-2 position, 3-5 normal, 6-7 texture, -1 nowhere.
int vertex_slot(const PlyProperty& property) {
    constexpr std::array<std::array<std::string_view, 3>, 8> names = {{{"x", "", ""},
                                                                       {"y", "", ""},
                                                                       {"z", "", ""},
                                                                       {"nx", "", ""},
                                                                       {"ny", "", ""},
                                                                       {"nz", "", ""},
                                                                       {"u", "s", "texture_u"},
                                                                       {"v", "t", "texture_v"}}};
    if (property.list) return -1;
    for (std::size_t slot = 0; slot < names.size(); ++slot)
        if (std::find(names[slot].begin(), names[slot].end(), property.name) != names[slot].end())
            return static_cast<int>(slot);
    return -1;
}

/// All of the slots or none of them.
bool has_slots(const std::vector<int>& slots, int first, int last, const SourceLocation& place) {
    int found = 0;
    for (int slot = first; slot <= last; ++slot) {
        const auto times = std::count(slots.begin(), slots.end(), slot);
        if (times > 1) refuse(place, "a vertex property is declared twice");
        found += static_cast<int>(times);
    }
    if (found != 0 && found != last - first + 1)
        refuse(place, "the vertices lack a component of position, normal or texture coordinate");
    return found != 0;
}

void note_skipped(MeshData& mesh, const PlyElement& element, const std::string& property,
                  const SourceLocation& place) {
    mesh.notes.push_back(place.file + ": property " + in_quotes(property) + " of the " +
                         element.name + " element is not used");
}

void read_vertices(PlyData& data, const PlyElement& element, bool flip_v, MeshData& mesh,
                   const SourceLocation& place) {
    std::vector<int> slots;
    for (const PlyProperty& property : element.properties) {
        slots.push_back(vertex_slot(property));
        if (slots.back() < 0) note_skipped(mesh, element, property.name, place);
    }
    if (!has_slots(slots, 0, 2, place)) refuse(place, "the vertices have no x, y and z");
    const bool normals = has_slots(slots, 3, 5, place);
    const bool uvs = has_slots(slots, 6, 7, place);
    if (element.count > data.bytes_left())
        refuse(place, "the header claims " + std::to_string(element.count) +
                          " vertices, more than the file can hold");
    for (std::uint64_t i = 0; i < element.count; ++i) {
        std::array<double, 8> v{};
        for (std::size_t k = 0; k < slots.size(); ++k) {
            if (slots[k] < 0)
                skip(data, element.properties[k]);
            else
                v[static_cast<std::size_t>(slots[k])] =
                    next_finite(data, element.properties[k].type);
        }
        mesh.positions.emplace_back(v[0], v[1], v[2]);
        if (normals) mesh.normals.emplace_back(v[3], v[4], v[5]);
        if (uvs) mesh.uvs.emplace_back(v[6], flip_v ? 1.0 - v[7] : v[7]);
    }
}

std::vector<double> read_list(PlyData& data, const PlyProperty& property) {
    std::vector<double> list(list_length(data, property));
    for (double& entry : list)
        entry = data.next(property.type);
    return list;
}

void add_polygon(const std::vector<double>& corners, MeshData& mesh, const PlyData& data) {
    if (corners.size() < 3) refuse(data.place(), "a face needs at least three corners");
    for (const double c : corners)
        if (!(c >= 0.0) || c != std::floor(c) || c >= static_cast<double>(mesh.positions.size()))
            refuse(data.place(), "a face uses vertex " + std::to_string(c) + " of " +
                                     std::to_string(mesh.positions.size()));
    for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
}

void read_faces(PlyData& data, const PlyElement& element, MeshData& mesh,
                const SourceLocation& place) {
    const auto is_corners = [](const PlyProperty& p) {
        return p.list && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    if (std::count_if(element.properties.begin(), element.properties.end(), is_corners) != 1)
        refuse(place, "the faces need one list \"vertex_indices\" (or \"vertex_index\")");
    for (const PlyProperty& property : element.properties)
        if (!is_corners(property)) note_skipped(mesh, element, property.name, place);
    for (std::uint64_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties) {
            if (is_corners(property))
                add_polygon(read_list(data, property), mesh, data);
            else
                skip(data, property);
        }
}

void skip_element(PlyData& data, const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties)
            skip(data, property);
}

} // namespace

MeshData parse_ply(std::string_view file, bool flip_v, const std::string& name) {
    const SourceLocation file_place{name, 0};
    const PlyHeader header = read_ply_header(file, name);
    PlyData data(file, header, file_place);
    MeshData mesh;
    bool vertices = false, faces = false;
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex" && !vertices) {
            read_vertices(data, element, flip_v, mesh, file_place);
            vertices = true;
        } else if (element.name == "face" && !faces && vertices) {
            read_faces(data, element, mesh, file_place);
            faces = true;
        } else if (element.name == "vertex" || element.name == "face") {
            refuse(file_place, "the elements must be one \"vertex\" and then one \"face\"");
        } else {
            skip_element(data, element);
            mesh.notes.push_back(file_place.file + ": element " + in_quotes(element.name) +
                                 " is not used");
        }
    }
    if (data.has_more())
        mesh.notes.push_back(file_place.file + ": data after the last element is not used");
    if (!faces) refuse(file_place, "the PLY file has no \"face\" element (points are not drawn)");
    return mesh;
}

MeshData load_ply(const std::filesystem::path& path, bool flip_v, const SourceLocation& place) {
    return parse_ply(read_whole_file(path, place, max_file_bytes), flip_v, path.string());
}

} // namespace parhelion
