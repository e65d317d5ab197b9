// The header of a PLY file: which elements with which properties follow, in which encoding.
#pragma once

#include "host/error.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyProperty {
    std::string name;
    PlyType type;
    bool list = false;
    PlyType count_type = PlyType::uint8; ///< of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::size_t data_start = 0; ///< byte after the line "end_header"
    int lines = 0;              ///< of the header
    std::size_t unknown_lines = 0;
    std::string first_unknown; ///< what they begin with, and where
};

std::size_t ply_type_size(PlyType type);

/// Bytes that an entry of `element` takes at least, in text with a blank after every number.
std::size_t least_bytes(const PlyElement& element, PlyEncoding encoding);

/// Lines end as the first one does: in LF, CR LF or CR. Throws InputError with file and line.
PlyHeader read_ply_header(std::string_view file, const std::string& name);

} // namespace parhelion
