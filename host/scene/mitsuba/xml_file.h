// One XML file: parsed, with line numbers, and without the dangerous parts of XML.
#pragma once

#include "host/error.h"

#include <pugixml.hpp>

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace parhelion::mitsuba {

class XmlFile {
public:
    /// Throws InputError for a text that is not well-formed UTF-8 XML, or that holds a document
    /// type, an entity beyond the five of XML itself, or anything beside one root element.
    XmlFile(std::string name, std::string text);

    pugi::xml_node root() const { return document_.document_element(); }
    SourceLocation location(pugi::xml_node node) const;
    const std::string& name() const { return name_; }

private:
    SourceLocation location_of_offset(std::ptrdiff_t offset) const;
    void refuse_entities() const;
    void refuse_beside_root() const;

    std::string name_;
    std::string text_;
    std::vector<std::size_t> line_starts_;
    pugi::xml_document document_;
};

/// Throws InputError for a file that cannot be read, and as XmlFile does. `asked_from` is the place
/// of the <include>, or the file itself.
XmlFile read_xml_file(const std::filesystem::path& path, const SourceLocation& asked_from);

/// Refuses attributes that are not in `allowed`, and missing ones that are marked by a leading '!'.
void check_attributes(const XmlFile& xml, pugi::xml_node node,
                      std::initializer_list<std::string_view> allowed);

/// Refuses any element inside `node`.
void refuse_content(const XmlFile& xml, pugi::xml_node node);

} // namespace parhelion::mitsuba
