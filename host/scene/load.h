// Reading a scene file into a Scene.
#pragma once

#include "host/scene/scene.h"

#include <map>
#include <string>

namespace parhelion {

struct LoadOptions {
    std::map<std::string, std::string>
        parameters;             ///< -D name=value, replacing the file's <default>s
    bool allow_outside = false; ///< let the scene name files outside its own folder
};

/// Loads a scene (the format is chosen by the file's extension).
/// Throws InputError, one line, for anything that cannot be rendered exactly as written.
Scene load_scene(const std::string& file, const LoadOptions& options = {});

} // namespace parhelion
