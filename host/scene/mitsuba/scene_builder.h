// From a Mitsuba document to a Scene.
#pragma once

#include "host/scene/load.h"

namespace parhelion::mitsuba {

class XmlFile;

/// Loads an existing XML file. Throws InputError.
Scene load_xml_scene(const std::string& file, const LoadOptions& options);

/// The same of a file at hand; what its scene names is looked for in the folder of its name.
Scene parse_xml_scene(const XmlFile& xml, const LoadOptions& options);

/// What an XML file is written of. Throws InputError where it cannot be read.
std::vector<Construct> xml_constructs(const std::string& file, const LoadOptions& options);

} // namespace parhelion::mitsuba
