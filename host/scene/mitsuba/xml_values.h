// The elements that hold a value: <float>, <rgb>, <transform> and their kin.
#pragma once

#include "host/scene/mitsuba/document.h"
#include "host/scene/mitsuba/xml_file.h"

namespace parhelion::mitsuba {

/// Whether elements of that name hold a value.
bool is_value_tag(std::string_view tag);

/// The value of `node`, whose parameters are already substituted; `before_2_0`: in a file older
/// than that version. Throws InputError for an unknown element, unexpected attributes, and values
/// that cannot be read.
Value read_value(const XmlFile& xml, pugi::xml_node node, const FileFinder& files,
                 std::vector<std::string>& notes, bool before_2_0);

} // namespace parhelion::mitsuba
