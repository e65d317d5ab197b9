// The lines of an OBJ file that hold vertices; the faces are read after all of them.
#include "host/scene/meshes/obj_vertices.h"

#include "host/scene/text.h"

#include <algorithm>

namespace parhelion {

namespace {

/// Beyond x y z [w] a vertex has a colour.
constexpr std::size_t numbers_with_color = 6;

class VertexLines {
public:
    VertexLines(bool flip_v, const std::string& name) : flip_v_(flip_v), place_{name, 0} {}

    void read(LineReader& lines);
    ObjVertices finish() &&;

private:
    const std::vector<double>& numbers(LineReader& lines, std::size_t needed);
    void skip(std::string_view word);

    bool flip_v_;
    SourceLocation place_;
    ObjVertices vertices_;
    std::size_t colored_ = 0, lines_or_points_ = 0, unknown_ = 0;
    std::string first_unknown_;
    std::vector<std::string_view> words_; ///< of the current line
    std::vector<double> numbers_;
};

const std::vector<double>& VertexLines::numbers(LineReader& lines, std::size_t needed) {
    split_words(whole_obj_line(lines), words_);
    if (words_.size() < needed + 1)
        refuse(place_, in_quotes(words_[0]) + " takes at least " + std::to_string(needed) +
                           " numbers, found " + std::to_string(words_.size() - 1));
    numbers_.clear();
    for (std::size_t i = 1; i < words_.size(); ++i) {
        const auto value = parse_real(words_[i]);
        if (!value) refuse(place_, in_quotes(words_[i]) + " is not a number");
        numbers_.push_back(*value);
    }
    return numbers_;
}

/// Lines that hold no vertex.
void VertexLines::skip(std::string_view word) {
    if (obj_line(word) == ObjLine::shape)
        refuse(place_, in_quotes(word) + " describes geometry that is not read (accepted: faces, "
                                         "\"f\", of vertices \"v\")");
    if (obj_line(word) == ObjLine::line_or_point) ++lines_or_points_;
    if (obj_line(word) != ObjLine::unknown) return;
    const std::string lower = lower_case(word);
    if (obj_line(lower) <= ObjLine::face)
        refuse(place_,
               in_quotes(word) + " is no word of OBJ files (accepted: " + in_quotes(lower) + ")");
    if (unknown_++ == 0)
        first_unknown_ = in_quotes(word) + " in line " + std::to_string(place_.line);
}

void VertexLines::read(LineReader& lines) {
    const std::string_view word = first_word(without_obj_comment(lines.line()));
    if (word.empty()) return;
    place_.line = lines.number();
    switch (obj_line(word)) {
    case ObjLine::vertex: {
        const std::vector<double>& n = numbers(lines, 3);
        vertices_.positions.emplace_back(n[0], n[1], n[2]);
        colored_ += n.size() >= numbers_with_color;
        break;
    }
    case ObjLine::texture_vertex: {
        const std::vector<double>& n = numbers(lines, 1);
        const double v = n.size() > 1 ? n[1] : 0.0;
        vertices_.texture_vertices.emplace_back(n[0], flip_v_ ? 1.0 - v : v);
        break;
    }
    case ObjLine::normal: {
        const std::vector<double>& n = numbers(lines, 3);
        vertices_.normals.emplace_back(n[0], n[1], n[2]);
        break;
    }
    case ObjLine::face:
        whole_obj_line(lines);
        break;
    default:
        skip(word);
        if (obj_line(word) == ObjLine::line_or_point) whole_obj_line(lines);
    }
}

ObjVertices VertexLines::finish() && {
    if (lines_or_points_ > 0) vertices_.notes.emplace_back("lines and points are not drawn");
    if (colored_ > 0) vertices_.notes.emplace_back("vertex colours are not used");
    if (unknown_ > 0)
        vertices_.notes.push_back(std::to_string(unknown_) +
                                  (unknown_ == 1 ? " line begins with a word that is"
                                                 : " lines begin with words that are") +
                                  " not known; not used (first: " + first_unknown_ + ")");
    return std::move(vertices_);
}

} // namespace

std::string_view without_obj_comment(std::string_view line) {
    std::size_t mark = line.find('#');
    while (mark != std::string_view::npos && mark > 0 && line[mark - 1] == '.')
        mark = line.find('#', mark + 1);
    return line.substr(0, mark);
}

std::string_view whole_obj_line(LineReader& lines) {
    std::size_t seen = 0;
    for (;;) {
        const std::string_view line = lines.line();
        const std::size_t end = without_obj_comment(line.substr(seen)).size();
        if (seen + end < line.size()) return line.substr(0, seen + end);
        seen = line.size();
        if (!lines.join_continued()) return line;
    }
}

std::string_view first_word(std::string_view line) {
    line = without_utf8_mark(line); // inside of files that were put together
    const std::size_t start = line.find_first_not_of(" \t\v\f");
    if (start == std::string_view::npos) return {};
    line.remove_prefix(start);
    return line.substr(0, line.find_first_of(" \t\v\f\r\n"));
}

ObjVertices read_obj_vertices(std::string_view text, bool flip_v, const std::string& name) {
    VertexLines vertices(flip_v, name);
    LineReader lines(text);
    while (lines.next())
        vertices.read(lines);
    return std::move(vertices).finish();
}

} // namespace parhelion
