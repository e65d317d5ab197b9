// Reading a scene file into a Scene.
#pragma once

#include "host/scene/construct.h"
#include "host/scene/scene.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace parhelion {

class KeptMeshes; // host/scene/meshes/kept_meshes.h

struct LoadOptions {
    std::map<std::string, std::string>
        parameters;              ///< -D name=value, replacing the file's <default>s
    bool allow_outside = false;  ///< let the scene name files outside its own folder
    std::optional<int> sensor{}; ///< which of the file's, from 0; absent: the first
    /// The caller brings an integrator: one in the file that is not known is no mistake then.
    bool own_integrator = false;
    /// What is not known is left out, or read as what is nearest, each with a note.
    bool lenient = false;
    /// Is told of each file that the scene names, before it is read; throws InputError for one that
    /// may not be.
    std::function<void(const std::string&)> check_file{};
    /// Of the scenes before, which this one takes over and adds to; null: there are none.
    KeptMeshes* meshes = nullptr;
};

/// Loads a scene (the format is chosen by the file's extension).
/// Throws InputError, a line for each thing that cannot be rendered exactly as written.
Scene load_scene(const std::string& file, const LoadOptions& options = {});

/// What the file is written of, known or not. Throws InputError where it cannot be read.
std::vector<Construct> scene_constructs(const std::string& file, const LoadOptions& options = {});

} // namespace parhelion
