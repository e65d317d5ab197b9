// The words that lines of OBJ files begin with, and what becomes of such lines.
#pragma once

#include <array>
#include <string_view>

namespace parhelion {

enum class ObjLine {
    vertex,
    texture_vertex,
    normal,
    face,
    line_or_point, ///< said once: not drawn
    harmless,      ///< names, materials, what belongs to curves and surfaces
    shape,         ///< geometry of a kind that is not read: refused
    unknown        ///< counted
};

struct ObjKeyword {
    std::string_view word;
    ObjLine kind;
};

/// Of the format's description (Wavefront, appendix B1, with the statements it supersedes).
inline constexpr std::array obj_keywords{
    ObjKeyword{"v", ObjLine::vertex},
    ObjKeyword{"vt", ObjLine::texture_vertex},
    ObjKeyword{"vn", ObjLine::normal},
    ObjKeyword{"f", ObjLine::face},
    ObjKeyword{"fo", ObjLine::face},
    ObjKeyword{"l", ObjLine::line_or_point},
    ObjKeyword{"p", ObjLine::line_or_point},
    ObjKeyword{"g", ObjLine::harmless},
    ObjKeyword{"o", ObjLine::harmless},
    ObjKeyword{"s", ObjLine::harmless},
    ObjKeyword{"mg", ObjLine::harmless},
    ObjKeyword{"usemtl", ObjLine::harmless},
    ObjKeyword{"mtllib", ObjLine::harmless},
    ObjKeyword{"usemap", ObjLine::harmless},
    ObjKeyword{"maplib", ObjLine::harmless},
    ObjKeyword{"bevel", ObjLine::harmless},
    ObjKeyword{"c_interp", ObjLine::harmless},
    ObjKeyword{"d_interp", ObjLine::harmless},
    ObjKeyword{"lod", ObjLine::harmless},
    ObjKeyword{"shadow_obj", ObjLine::harmless},
    ObjKeyword{"trace_obj", ObjLine::harmless},
    ObjKeyword{"ctech", ObjLine::harmless},
    ObjKeyword{"stech", ObjLine::harmless},
    ObjKeyword{"vp", ObjLine::harmless},
    ObjKeyword{"cstype", ObjLine::harmless},
    ObjKeyword{"deg", ObjLine::harmless},
    ObjKeyword{"bmat", ObjLine::harmless},
    ObjKeyword{"step", ObjLine::harmless},
    ObjKeyword{"parm", ObjLine::harmless},
    ObjKeyword{"trim", ObjLine::harmless},
    ObjKeyword{"hole", ObjLine::harmless},
    ObjKeyword{"scrv", ObjLine::harmless},
    ObjKeyword{"sp", ObjLine::harmless},
    ObjKeyword{"con", ObjLine::harmless},
    ObjKeyword{"end", ObjLine::harmless},
    ObjKeyword{"res", ObjLine::harmless},
    ObjKeyword{"curv", ObjLine::shape},
    ObjKeyword{"curv2", ObjLine::shape},
    ObjKeyword{"surf", ObjLine::shape},
    ObjKeyword{"bzp", ObjLine::shape},
    ObjKeyword{"bsp", ObjLine::shape},
    ObjKeyword{"cdc", ObjLine::shape},
    ObjKeyword{"cdp", ObjLine::shape},
    ObjKeyword{"call", ObjLine::shape}, // the lines of another file
};

constexpr ObjLine obj_line(std::string_view word) {
    for (const ObjKeyword& keyword : obj_keywords)
        if (keyword.word == word) return keyword.kind;
    return ObjLine::unknown;
}

} // namespace parhelion
