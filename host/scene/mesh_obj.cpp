// Wavefront OBJ meshes.
#include "host/scene/mesh_obj.h"

#include "host/scene/file_finder.h"
#include "host/scene/text.h"

// Compiled in rather than linked: in double precision, and seen by the sanitizers.
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace parhelion {

namespace {

constexpr std::size_t max_obj_bytes = std::size_t(4) << 30;
constexpr std::size_t max_corners = 255; ///< the library counts them in a byte

/// Of what the library reads as the number it is: it multiplies digits and powers of ten one by
/// one, where more of either overflow to infinity or to 0 * infinity.
constexpr std::size_t max_number_length = 100;
constexpr std::int64_t max_exponent = 200;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Splits at blanks into `words`, whose memory is used again for the next line.
void split_line(std::string_view line, std::vector<std::string_view>& words) {
    words.clear();
    for (std::size_t i = 0; i < line.size();) {
        const std::size_t start = i;
        while (i < line.size() && !is_blank(line[i]))
            ++i;
        if (i > start) words.push_back(line.substr(start, i - start));
        ++i;
    }
}

bool is_readable(std::string_view number) {
    if (!parse_number(number) || number.size() > max_number_length) return false;
    const std::size_t e = number.find_first_of("eE");
    if (e == std::string_view::npos) return true;
    const auto exponent = parse_integer(number.substr(e + 1));
    return exponent && std::abs(*exponent) <= max_exponent;
}

/// The library takes 0 for a number it cannot read; so all numbers are looked at beforehand.
void check_numbers(const std::vector<std::string_view>& words, std::size_t needed,
                   const SourceLocation& place) {
    if (words.size() < needed + 1)
        refuse(place, in_quotes(words[0]) + " takes at least " + std::to_string(needed) +
                          " numbers, found " + std::to_string(words.size() - 1));
    for (std::size_t i = 1; i < words.size(); ++i)
        if (!is_readable(words[i]))
            refuse(place, in_quotes(words[i]) + " is not a finite number of at most " +
                              std::to_string(max_number_length) +
                              " characters and an exponent of " + std::to_string(max_exponent));
}

/// Looks at every line and keeps from the library what is not used: it takes numbers there that no
/// integer can hold.
class TextCheck {
public:
    explicit TextCheck(const std::string& name) : place_{name, 0} {}

    /// `text` with the other lines, and comments, left empty.
    std::string used_lines(std::string text);
    bool lines_or_points() const { return lines_or_points_; } ///< there were some

private:
    bool is_used(std::string_view line);
    void check_corner(std::string_view corner) const;

    SourceLocation place_;
    bool lines_or_points_ = false;
    std::vector<std::string_view> words_;  ///< of the current line
    std::array<std::int64_t, 3> counts_{}; ///< of v, vt and vn so far
};

/// v, v/vt, v//vn or v/vt/vn. Indices count from 1, or back from -1; one that reaches back too far
/// would read as absent.
void TextCheck::check_corner(std::string_view corner) const {
    std::size_t part = 0;
    for (std::size_t start = 0; start <= corner.size(); ++part) {
        const std::size_t end = std::min(corner.find('/', start), corner.size());
        const std::string_view index = corner.substr(start, end - start);
        const bool left_out = index.empty() && part == 1 && end < corner.size();
        const std::int64_t value = parse_integer(index).value_or(0);
        if (part > 2 || (!left_out && (value == 0 || value > std::numeric_limits<int>::max())))
            refuse(place_, in_quotes(corner) + " is not a face corner (v, v/vt, v//vn, v/vt/vn; "
                                               "indices start at 1)");
        if (value < -counts_[part])
            refuse(place_, in_quotes(corner) + " counts back beyond the first of " +
                               std::to_string(counts_[part]));
        start = end + 1;
    }
}

bool TextCheck::is_used(std::string_view line) {
    split_line(line, words_);
    const std::vector<std::string_view>& words = words_;
    if (words.empty()) return false;
    if (words[0] == "v" || words[0] == "vn") {
        check_numbers(words, 3, place_);
        ++counts_[words[0] == "v" ? 0 : 2];
    } else if (words[0] == "vt") {
        check_numbers(words, 1, place_);
        ++counts_[1];
    } else if (words[0] == "f") {
        if (words.size() < 4 || words.size() > max_corners + 1)
            refuse(place_, "a face of " + std::to_string(words.size() - 1) +
                               " corners (accepted: 3 to " + std::to_string(max_corners) + ")");
        for (std::size_t i = 1; i < words.size(); ++i)
            check_corner(words[i]);
    } else {
        lines_or_points_ = lines_or_points_ || words[0] == "l" || words[0] == "p";
        return false;
    }
    return true;
}

std::string TextCheck::used_lines(std::string text) {
    std::size_t written = 0, feed = 0;
    for (std::size_t start = 0; start < text.size();) {
        if (feed <= start) feed = std::min(text.find('\n', start), text.size());
        std::string_view line = std::string_view(text).substr(start, feed - start);
        line = line.substr(0, line.find('\r')); // to the library the end of a line as well
        const std::size_t end = start + line.size();
        const bool both = end < feed && end + 1 == feed && feed < text.size();
        ++place_.line;
        line = line.substr(0, line.find('#'));
        if (is_used(line)) {
            std::copy(line.begin(), line.end(),
                      text.begin() + static_cast<std::ptrdiff_t>(written));
            written += line.size();
        }
        if (written < text.size()) text[written++] = '\n';
        start = end + (both ? 2 : 1);
    }
    text.resize(written);
    return text;
}

/// Corners that share position, texture and normal index become one vertex.
class VertexTable {
public:
    VertexTable(const tinyobj::attrib_t& attributes, bool flip_v, const SourceLocation& place)
        : attributes_(attributes), flip_v_(flip_v), place_(place),
          latest_(attributes.vertices.size() / 3, no_vertex) {}

    std::uint32_t vertex(const tinyobj::index_t& corner);
    MeshData mesh;

private:
    const double* entry(const std::vector<double>& values, int index, std::size_t width,
                        const char* what) const;

    /// A vertex made from a position, and the next one made from the same.
    struct Link {
        int texture, normal;
        std::uint32_t next;
    };
    static constexpr std::uint32_t no_vertex = ~std::uint32_t(0);

    const tinyobj::attrib_t& attributes_;
    bool flip_v_;
    const SourceLocation& place_;
    std::vector<std::uint32_t> latest_; ///< by position: the vertex last made from it
    std::vector<Link> links_;           ///< by vertex
};

const double* VertexTable::entry(const std::vector<double>& values, int index, std::size_t width,
                                 const char* what) const {
    const std::size_t count = values.size() / width;
    if (index < 0 || static_cast<std::size_t>(index) >= count)
        refuse(place_, std::string("a face uses ") + what + " " + std::to_string(index + 1) +
                           " of " + std::to_string(count));
    return &values[static_cast<std::size_t>(index) * width];
}

std::uint32_t VertexTable::vertex(const tinyobj::index_t& corner) {
    const std::array<int, 3> key = {corner.vertex_index, corner.texcoord_index,
                                    corner.normal_index};
    const double* const p = entry(attributes_.vertices, key[0], 3, "vertex");
    std::uint32_t& latest = latest_[static_cast<std::size_t>(key[0])];
    for (std::uint32_t v = latest; v != no_vertex; v = links_[v].next)
        if (links_[v].texture == key[1] && links_[v].normal == key[2]) return v;
    links_.push_back({key[1], key[2], latest});
    latest = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(p[0], p[1], p[2]);
    glm::dvec2 uv(0.0);
    if (key[1] != -1) {
        const double* const t = entry(attributes_.texcoords, key[1], 2, "texture vertex");
        uv = {t[0], flip_v_ ? 1.0 - t[1] : t[1]};
    }
    mesh.uvs.push_back(uv);
    glm::dvec3 normal(0.0);
    if (key[2] != -1) {
        const double* const n = entry(attributes_.normals, key[2], 3, "normal");
        normal = {n[0], n[1], n[2]};
        if (normal == glm::dvec3(0.0))
            refuse(place_, "vertex normal " + std::to_string(key[2] + 1) + " is zero");
    }
    mesh.normals.push_back(normal);
    return latest;
}

void add_faces(VertexTable& table, const tinyobj::mesh_t& faces, const SourceLocation& place) {
    std::size_t first = 0;
    for (const std::size_t corners : faces.num_face_vertices) {
        if (corners < 3 || first + corners > faces.indices.size())
            refuse(place, "a face has an unusable number of corners");
        std::vector<std::uint32_t> polygon;
        for (std::size_t i = 0; i < corners; ++i)
            polygon.push_back(table.vertex(faces.indices[first + i]));
        for (std::size_t i = 2; i < corners; ++i)
            table.mesh.triangles.emplace_back(polygon[0], polygon[i - 1], polygon[i]);
        first += corners;
    }
    if (first != faces.indices.size()) refuse(place, "the faces do not add up");
}

} // namespace

MeshData parse_obj(std::string text, bool flip_v, const std::string& name) {
    const SourceLocation file{name, 0};
    TextCheck check(name);
    text = check.used_lines(std::move(text));
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warnings, errors;
    std::istringstream stream(std::move(text));
    const bool good = tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors,
                                       &stream, nullptr, /*triangulate=*/false,
                                       /*default_vcols_fallback=*/false);
    if (!good) refuse(file, "not a usable OBJ file: " + errors.substr(0, errors.find('\n')));
    VertexTable table(attributes, flip_v, file);
    for (const tinyobj::shape_t& shape : shapes)
        add_faces(table, shape.mesh, file);
    if (check.lines_or_points())
        table.mesh.notes.push_back(file.file + ": lines and points are not drawn");
    if (attributes.texcoords.empty()) table.mesh.uvs.clear();
    const auto is_zero = [](const glm::dvec3& n) { return n == glm::dvec3(0.0); };
    if (std::all_of(table.mesh.normals.begin(), table.mesh.normals.end(), is_zero))
        table.mesh.normals.clear();
    return std::move(table.mesh);
}

MeshData load_obj(const std::filesystem::path& path, bool flip_v, const SourceLocation& place) {
    return parse_obj(read_whole_file(path, place, max_obj_bytes), flip_v, path.string());
}

} // namespace parhelion
