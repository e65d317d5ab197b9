// Stanford PLY meshes, text and binary.
//
// Why a reader of our own: the one library Debian 12 has for it (Assimp 5.2.5) rounds to single
// precision, writes out of bounds on files made to do so, and takes misread data for a mesh.
#include "host/scene/meshes/mesh_ply.h"

#include "host/scene/file_finder.h"
#include "host/scene/meshes/data_text.h"
#include "host/scene/meshes/mesh_builder.h"
#include "host/scene/meshes/ply_attributes.h"
#include "host/scene/meshes/ply_data.h"
#include "host/scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace parhelion {

namespace {

constexpr std::size_t max_file_bytes = std::size_t(4) << 30;

std::uint32_t list_length(PlyData& data, const PlyProperty& property) {
    const double count = data.next(property.count_type);
    const std::size_t least =
        data.encoding() == PlyEncoding::ascii ? 2 : ply_type_size(property.type);
    if (!(count >= 0.0) || count != std::floor(count) ||
        count > static_cast<double>(data.most_entries(least)))
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

/// Where each property goes. Of a normal or a texture coordinate that is not whole, or stands there
/// twice, what is too much goes nowhere.
std::vector<int> vertex_slots(const PlyElement& element, const SourceLocation& place) {
    std::vector<int> slots;
    for (const PlyProperty& property : element.properties) {
        const int slot = vertex_slot(property);
        const bool again = slot >= 0 && std::find(slots.begin(), slots.end(), slot) != slots.end();
        if (again && slot <= 2) refuse(place, in_quotes(property.name) + " is declared twice");
        slots.push_back(again ? -1 : slot);
    }
    for (const auto& [first, last] : {std::pair(0, 2), std::pair(3, 5), std::pair(6, 7)}) {
        const auto inside = [first = first, last = last](int slot) {
            return slot >= first && slot <= last;
        };
        if (std::count_if(slots.begin(), slots.end(), inside) == last - first + 1) continue;
        if (first == 0) refuse(place, "the vertices lack x, y or z");
        std::replace_if(slots.begin(), slots.end(), inside, -1);
    }
    return slots;
}

bool has_slot(const std::vector<int>& slots, int slot) {
    return std::find(slots.begin(), slots.end(), slot) != slots.end();
}

void note_skipped(MeshBuilder& builder, const PlyElement& element, const std::string& property) {
    builder.note("property " + in_quotes(property) + " of the " + element.name +
                 " element is not used");
}

/// A header that claims more entries than the file has bytes for costs no memory.
void check_count(const PlyData& data, const PlyElement& element, const SourceLocation& place) {
    if (element.count > data.most_entries(least_bytes(element, data.encoding())))
        refuse(place, "the header claims " + std::to_string(element.count) + " entries of " +
                          in_quotes(element.name) + ", more than the file can hold");
}

void read_vertices(PlyData& data, const PlyElement& element, bool flip_v, MeshBuilder& builder,
                   const SourceLocation& place) {
    const std::vector<int> slots = vertex_slots(element, place);
    std::vector<bool> taken(slots.size());
    for (std::size_t k = 0; k < slots.size(); ++k)
        taken[k] = vertex_slot(element.properties[k]) >= 0;
    PlyAttributeRow row(attributes_of(element, taken));
    for (std::size_t k = 0; k < slots.size(); ++k)
        if (slots[k] < 0 && !row.has(k)) note_skipped(builder, element, element.properties[k].name);
    const bool normals = has_slot(slots, 3), uvs = has_slot(slots, 6);
    MeshData& mesh = builder.mesh;
    mesh.attributes = row.attributes();
    mesh.positions.reserve(element.count);
    if (normals) mesh.normals.reserve(element.count);
    if (uvs) mesh.uvs.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
        std::array<double, 8> v{};
        for (std::size_t k = 0; k < slots.size(); ++k) {
            if (row.has(k))
                row.set(k, data.next(element.properties[k].type));
            else if (slots[k] < 0)
                skip(data, element.properties[k]);
            else
                v[static_cast<std::size_t>(slots[k])] = data.next(element.properties[k].type);
        }
        mesh.positions.emplace_back(v[0], v[1], v[2]);
        if (normals) mesh.normals.push_back(normal_in_file({v[3], v[4], v[5]}));
        if (uvs) mesh.uvs.emplace_back(v[6], flip_v ? 1.0 - v[7] : v[7]);
        row.add_to(mesh.attributes, 0, 1);
    }
}

void read_corners(PlyData& data, const PlyProperty& property, std::size_t vertices,
                  std::vector<std::uint32_t>& corners) {
    corners.clear();
    const std::uint32_t count = list_length(data, property);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double c = data.next(property.type);
        if (!(c >= 0.0) || c != std::floor(c) || c >= static_cast<double>(vertices))
            refuse(data.place(),
                   "a face uses vertex " + std::to_string(c) + " of " + std::to_string(vertices));
        corners.push_back(static_cast<std::uint32_t>(c));
    }
}

void read_faces(PlyData& data, const PlyElement& element, MeshBuilder& builder,
                const SourceLocation& place) {
    const auto is_corners = [](const PlyProperty& p) {
        return p.list && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    const auto lists =
        std::count_if(element.properties.begin(), element.properties.end(), is_corners);
    if (lists != 1 && element.count > 0)
        refuse(place, "the faces need one list \"vertex_indices\" (or \"vertex_index\")");
    PlyAttributeRow row(
        attributes_of(element, std::vector<bool>(element.properties.size(), false)));
    for (std::size_t k = 0; k < element.properties.size(); ++k)
        if (!is_corners(element.properties[k]) && !row.has(k))
            note_skipped(builder, element, element.properties[k].name);
    MeshData& mesh = builder.mesh;
    const std::size_t first = mesh.attributes.size();
    mesh.attributes.insert(mesh.attributes.end(), row.attributes().begin(), row.attributes().end());
    std::vector<std::uint32_t> corners;
    for (std::uint64_t i = 0; i < element.count; ++i) {
        const std::size_t triangles = mesh.triangles.size();
        for (std::size_t k = 0; k < element.properties.size(); ++k) {
            const PlyProperty& property = element.properties[k];
            if (is_corners(property)) {
                read_corners(data, property, mesh.positions.size(), corners);
                builder.add_face(corners, data.place());
            } else if (row.has(k)) {
                row.set(k, data.next(property.type));
            } else {
                skip(data, property);
            }
        }
        row.add_to(mesh.attributes, first, mesh.triangles.size() - triangles);
    }
}

/// Elements of other names that hold surfaces: leaving them out would lose geometry.
void refuse_geometry(const PlyElement& element, const SourceLocation& place) {
    constexpr std::array<std::string_view, 4> surfaces = {"tristrips", "tristrip", "trifan",
                                                          "range_grid"};
    const std::string lower = lower_case(element.name);
    const bool misspelt = lower == "face" || lower == "vertex";
    if (element.count > 0 &&
        (misspelt || std::find(surfaces.begin(), surfaces.end(), lower) != surfaces.end()))
        refuse(place, "element " + in_quotes(element.name) +
                          " describes geometry that is not read (accepted: one \"vertex\" and "
                          "then one \"face\")");
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
    std::string converted;
    if (is_utf16(file, file_place)) file = converted = ascii_of_utf16(file);
    file = without_utf8_mark(file);
    const PlyHeader header = read_ply_header(file, name);
    PlyData data(file, header, file_place);
    MeshBuilder builder(name);
    builder.note_count(
        header.unknown_lines, "line of the header begins", "lines of the header begin",
        " with no word of PLY files; not used (first: " + header.first_unknown + ")");
    bool vertices = false, faces = false;
    for (const PlyElement& element : header.elements) {
        check_count(data, element, file_place);
        if (element.name == "vertex" && !vertices) {
            read_vertices(data, element, flip_v, builder, file_place);
            vertices = true;
        } else if (element.name == "face" && !faces && vertices) {
            read_faces(data, element, builder, file_place);
            faces = true;
        } else {
            refuse_geometry(element, file_place);
            skip_element(data, element);
            builder.note("element " + in_quotes(element.name) + " is not used");
        }
    }
    if (data.has_more()) builder.note("data after the last element is not used");
    if (!faces) builder.note("there is no \"face\" element (points are not drawn)");
    return std::move(builder).finish();
}

MeshData load_ply(const std::filesystem::path& path, bool flip_v, const SourceLocation& place) {
    return parse_ply(read_whole_file(path, place, max_file_bytes), flip_v, path.string());
}

} // namespace parhelion
