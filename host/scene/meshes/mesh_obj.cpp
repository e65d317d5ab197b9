// Wavefront OBJ meshes.
//
// Why a reader of our own: the library that Debian has for it (tinyobjloader 2.0) counts the
// corners of a face in a byte, rounds numbers several times, and reads as 0 or not at all what it
// does not know; keeping that from it took more than reading.
#include "host/scene/meshes/mesh_obj.h"

#include "host/scene/file_finder.h"
#include "host/scene/meshes/mesh_builder.h"
#include "host/scene/meshes/obj_vertices.h"
#include "host/scene/text.h"

#include <array>
#include <limits>

namespace parhelion {

namespace {

constexpr std::size_t max_obj_bytes = std::size_t(4) << 30;

/// Of position, texture vertex and normal; 0 where left out, else as written.
using Corner = std::array<std::int64_t, 3>;

constexpr std::int64_t left_out = -1;

class FaceLines {
public:
    FaceLines(const ObjVertices& vertices, const std::string& name);

    void read(LineReader& lines);
    MeshData finish() &&;

private:
    Corner parse_corner(std::string_view text) const;
    std::int64_t index(std::int64_t written, std::size_t part);
    std::uint32_t vertex(const Corner& corner);

    /// A vertex made from a position, and the next one made from the same.
    struct Link {
        std::int32_t texture, normal;
        std::uint32_t next;
    };
    static constexpr std::uint32_t no_vertex = ~std::uint32_t(0);

    const ObjVertices& file_;
    SourceLocation place_;
    MeshBuilder builder_;
    std::array<std::size_t, 3> totals_;    ///< of positions, texture vertices and normals
    std::array<std::int64_t, 3> so_far_{}; ///< of those, above the current line
    std::size_t absent_ = 0;               ///< texture vertices and normals asked for in vain
    std::vector<std::uint32_t> latest_;    ///< by position: the vertex last made from it
    std::vector<Link> links_;              ///< by vertex
    std::vector<std::string_view> words_;
    std::vector<std::uint32_t> corners_;
};

constexpr std::array<const char*, 3> part_names = {"vertex", "texture vertex", "normal"};

FaceLines::FaceLines(const ObjVertices& vertices, const std::string& name)
    : file_(vertices), place_{name, 0},
      builder_(name), totals_{vertices.positions.size(), vertices.texture_vertices.size(),
                              vertices.normals.size()},
      latest_(vertices.positions.size(), no_vertex) {
    if (totals_[0] > std::size_t(std::numeric_limits<std::int32_t>::max()))
        refuse(place_, "more vertices than an index can name");
}

/// v, v/vt, v//vn or v/vt/vn, where a slash may also stand behind the last of them.
Corner FaceLines::parse_corner(std::string_view text) const {
    Corner corner{};
    std::size_t part = 0, start = 0;
    for (; start <= text.size(); ++part) {
        const std::size_t end = std::min(text.find('/', start), text.size());
        const std::string_view number = text.substr(start, end - start);
        const std::int64_t value = parse_integer(number).value_or(0);
        const bool good = part < 3 && (value != 0 || (number.empty() && part > 0));
        if (!good)
            refuse(place_, in_quotes(text) + " is not a face corner (v, v/vt, v//vn, v/vt/vn; "
                                             "indices start at 1)");
        corner[part] = value;
        start = end + 1;
    }
    return corner;
}

/// From 0. Of parts that the file has none of at all every index is left out.
std::int64_t FaceLines::index(std::int64_t written, std::size_t part) {
    if (written == 0) return left_out;
    if (part > 0 && totals_[part] == 0) {
        ++absent_;
        return left_out;
    }
    if (written < -so_far_[part])
        refuse(place_, in_quotes(std::to_string(written)) + " counts back beyond the first of " +
                           std::to_string(so_far_[part]));
    const std::int64_t from_0 = written > 0 ? written - 1 : so_far_[part] + written;
    if (from_0 >= static_cast<std::int64_t>(totals_[part]))
        refuse(place_, std::string("a face uses ") + part_names[part] + " " +
                           std::to_string(from_0 + 1) + " of " + std::to_string(totals_[part]));
    return from_0;
}

/// Corners that share position, texture and normal index become one vertex.
std::uint32_t FaceLines::vertex(const Corner& corner) {
    const auto p = static_cast<std::size_t>(index(corner[0], 0));
    const auto texture = static_cast<std::int32_t>(index(corner[1], 1));
    const auto normal = static_cast<std::int32_t>(index(corner[2], 2));
    for (std::uint32_t v = latest_[p]; v != no_vertex; v = links_[v].next)
        if (links_[v].texture == texture && links_[v].normal == normal) return v;
    if (!is_finite(file_.positions[p]))
        refuse(place_,
               "the face uses vertex " + std::to_string(p + 1) + ", whose position is not finite");
    // Beside the vertices there are those of crossings, which no position leads to.
    links_.resize(builder_.mesh.positions.size(), {left_out, left_out, no_vertex});
    links_.push_back({texture, normal, latest_[p]});
    latest_[p] = static_cast<std::uint32_t>(builder_.mesh.positions.size());
    builder_.mesh.positions.push_back(file_.positions[p]);
    if (totals_[1] > 0)
        builder_.mesh.uvs.push_back(
            texture < 0 ? glm::dvec2(0.0)
                        : file_.texture_vertices[static_cast<std::size_t>(texture)]);
    if (totals_[2] > 0)
        builder_.mesh.normals.push_back(
            normal < 0 ? glm::dvec3(0.0)
                       : normal_in_file(file_.normals[static_cast<std::size_t>(normal)]));
    return latest_[p];
}

void FaceLines::read(LineReader& lines) {
    const ObjLine kind = obj_line(first_word(without_obj_comment(lines.line())));
    if (kind > ObjLine::line_or_point) return;
    const std::string_view line = whole_obj_line(lines);
    if (kind < ObjLine::face) ++so_far_[static_cast<std::size_t>(kind)];
    if (kind != ObjLine::face) return;
    place_.line = lines.number();
    split_words(line, words_);
    corners_.clear();
    for (std::size_t i = 1; i < words_.size() && words_.size() > 3; ++i)
        corners_.push_back(vertex(parse_corner(words_[i])));
    builder_.add_face(corners_, place_);
}

MeshData FaceLines::finish() && {
    for (const std::string& note : file_.notes)
        builder_.note(note);
    builder_.note_count(absent_, "corner names", "corners name",
                        " a texture vertex or normal, of which the file has none");
    return std::move(builder_).finish();
}

} // namespace

MeshData parse_obj(std::string text, bool flip_v, const std::string& name) {
    if (is_utf16(text, {name, 0})) text = ascii_of_utf16(text);
    const std::string_view bytes = without_utf8_mark(text);
    const ObjVertices vertices = read_obj_vertices(bytes, flip_v, name);
    FaceLines faces(vertices, name);
    LineReader lines(bytes);
    while (lines.next())
        faces.read(lines);
    return std::move(faces).finish();
}

MeshData load_obj(const std::filesystem::path& path, bool flip_v, const SourceLocation& place) {
    return parse_obj(read_whole_file(path, place, max_obj_bytes), flip_v, path.string());
}

} // namespace parhelion
