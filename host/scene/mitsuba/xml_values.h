// The elements that hold a value: <float>, <rgb>, <transform> and their kin.
#pragma once

#include "host/scene/mitsuba/document.h"
#include "host/scene/mitsuba/xml_file.h"

namespace parhelion::mitsuba {

/// The value of `node`, whose parameters are already substituted. Throws InputError for an unknown
/// element, unexpected attributes, and values that cannot be read.
Value read_value(const XmlFile& xml, pugi::xml_node node, const FileFinder& files,
                 std::vector<std::string>& notes);

} // namespace parhelion::mitsuba
