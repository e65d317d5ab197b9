// What a scene file is written of, before anything is made of it.
#pragma once

#include "host/error.h"

#include <string>
#include <vector>

namespace parhelion {

/// A plugin of a scene file, and every place that says something of it.
struct Construct {
    std::string kind;                   ///< "bsdf", "shape", ...
    std::string plugin;                 ///< "diffuse", "obj", ..., as the file has it
    std::vector<SourceLocation> places; ///< its own first, then those of its parameters
};

} // namespace parhelion
