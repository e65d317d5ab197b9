// The lines of an OBJ file that hold vertices; the faces are read after all of them.
#pragma once

#include "host/error.h"
#include "host/scene/meshes/data_text.h"
#include "host/scene/meshes/obj_keywords.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

struct ObjVertices {
    std::vector<glm::dvec3> positions, normals;
    std::vector<glm::dvec2> texture_vertices;
    std::vector<std::string> notes; ///< what was skipped, without the file's name
};

/// `text` in ASCII or UTF-8. Numbers may be other than finite. Throws InputError for lines that
/// hold no numbers where they should, and for geometry of other kinds.
ObjVertices read_obj_vertices(std::string_view text, bool flip_v, const std::string& name);

/// A line up to its comment: a '#' that is not part of a number ("1.#QNAN").
std::string_view without_obj_comment(std::string_view line);

/// The current line and those it goes on in, up to a comment, in which a backslash means nothing.
std::string_view whole_obj_line(LineReader& lines);

/// The word that a line begins with; empty for a line without any.
std::string_view first_word(std::string_view line);

} // namespace parhelion
