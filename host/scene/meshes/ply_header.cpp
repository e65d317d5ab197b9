// The header of a PLY file: which elements with which properties follow, in which encoding.
#include "host/scene/meshes/ply_header.h"

#include "host/scene/meshes/data_text.h"
#include "host/scene/text.h"

#include <algorithm>
#include <array>

namespace parhelion {

namespace {

struct TypeName {
    std::string_view old_name, new_name;
    PlyType type;
    std::size_t size;
};

constexpr std::array<TypeName, 8> type_names = {{{"char", "int8", PlyType::int8, 1},
                                                 {"uchar", "uint8", PlyType::uint8, 1},
                                                 {"short", "int16", PlyType::int16, 2},
                                                 {"ushort", "uint16", PlyType::uint16, 2},
                                                 {"int", "int32", PlyType::int32, 4},
                                                 {"uint", "uint32", PlyType::uint32, 4},
                                                 {"float", "float32", PlyType::float32, 4},
                                                 {"double", "float64", PlyType::float64, 8}}};

PlyType type_of(std::string_view word, const SourceLocation& place) {
    for (const TypeName& t : type_names)
        if (word == t.old_name || word == t.new_name) return t.type;
    refuse(place, "unknown PLY type " + in_quotes(word));
}

using Words = std::vector<std::string_view>;

PlyEncoding encoding_of(const Words& words, const SourceLocation& place) {
    if (words.size() == 3 && words[2] == "1.0") {
        if (words[1] == "ascii") return PlyEncoding::ascii;
        if (words[1] == "binary_little_endian") return PlyEncoding::little_endian;
        if (words[1] == "binary_big_endian") return PlyEncoding::big_endian;
    }
    refuse(place, "the format must be \"ascii\", \"binary_little_endian\" or "
                  "\"binary_big_endian\", version 1.0");
}

PlyElement element_of(const Words& words, const SourceLocation& place) {
    const std::optional<std::int64_t> count =
        words.size() == 3 ? parse_integer(words[2]) : std::nullopt;
    if (!count || *count < 0) refuse(place, "an element is written \"element <name> <count>\"");
    return {std::string(words[1]), static_cast<std::uint64_t>(*count), {}};
}

PlyProperty property_of(const Words& words, const SourceLocation& place) {
    if (words.size() == 3)
        return {std::string(words[2]), type_of(words[1], place), false, PlyType::uint8};
    if (words.size() != 5 || words[1] != "list")
        refuse(place, "a property is written \"property <type> <name>\" or "
                      "\"property list <type> <type> <name>\"");
    const PlyType count_type = type_of(words[2], place);
    if (count_type == PlyType::float32 || count_type == PlyType::float64)
        refuse(place, "the length of a list must be an integer type");
    return {std::string(words[4]), type_of(words[3], place), true, count_type};
}

} // namespace

std::size_t ply_type_size(PlyType type) {
    return std::find_if(type_names.begin(), type_names.end(),
                        [&](const TypeName& t) { return t.type == type; })
        ->size;
}

std::size_t least_bytes(const PlyElement& element, PlyEncoding encoding) {
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
        const PlyType type = property.list ? property.count_type : property.type;
        bytes += encoding == PlyEncoding::ascii ? 2 : ply_type_size(type);
    }
    return bytes;
}

namespace {

constexpr std::array<std::string_view, 4> keywords = {"format", "element", "property",
                                                      "end_header"};

/// Reads line after line.
class HeaderReader {
public:
    explicit HeaderReader(const std::string& name) : place_{name, 0} {}

    /// Whether the header goes on.
    bool read(std::string_view line);
    PlyHeader header;
    const SourceLocation& place() const { return place_; }

private:
    void skip(std::string_view word);

    SourceLocation place_;
    bool has_format_ = false;
};

/// Programs write comments without the word "comment". What looks like a keyword is none of those.
void HeaderReader::skip(std::string_view word) {
    const std::string lower = lower_case(word);
    if (std::find(keywords.begin(), keywords.end(), lower) != keywords.end())
        refuse(place_, "unexpected " + in_quotes(word) + " in the header of a PLY file");
    if (header.unknown_lines++ == 0)
        header.first_unknown = in_quotes(word) + " in line " + std::to_string(place_.line);
}

bool HeaderReader::read(std::string_view line) {
    const Words words = split(without_utf8_mark(line), " \t\r");
    const bool first = place_.line++ == 0;
    if (first && (words.size() != 1 || words[0] != "ply"))
        refuse(place_, "not a PLY file: it does not start with a line \"ply\"");
    if (first || words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
    if (words[0] == "format") {
        header.encoding = encoding_of(words, place_);
        has_format_ = true;
    } else if (words[0] == "element") {
        header.elements.push_back(element_of(words, place_));
    } else if (words[0] == "property" && !header.elements.empty()) {
        header.elements.back().properties.push_back(property_of(words, place_));
    } else if (words[0] == "end_header" && has_format_) {
        header.lines = place_.line;
        return false;
    } else {
        skip(words[0]);
    }
    return true;
}

} // namespace

PlyHeader read_ply_header(std::string_view file, const std::string& name) {
    HeaderReader reader(name);
    const std::size_t first_end = std::min(file.find_first_of("\r\n"), file.size());
    const bool only_cr = file.substr(first_end, 1) == "\r" && file.substr(first_end + 1, 1) != "\n";
    for (std::size_t start = 0; start < file.size();) {
        const std::size_t end = std::min(file.find(only_cr ? '\r' : '\n', start), file.size());
        const bool goes_on = reader.read(file.substr(start, end - start));
        start = end + 1;
        if (goes_on) continue;
        reader.header.data_start = std::min(start, file.size());
        return std::move(reader.header);
    }
    refuse(reader.place(), "the header of the PLY file has no end");
}

} // namespace parhelion
