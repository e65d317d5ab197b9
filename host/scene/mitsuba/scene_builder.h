// From a Mitsuba document to a Scene.
#pragma once

#include "host/scene/load.h"

namespace parhelion::mitsuba {

/// Loads an existing XML file. Throws InputError.
Scene load_xml_scene(const std::string& file, const LoadOptions& options);

} // namespace parhelion::mitsuba
