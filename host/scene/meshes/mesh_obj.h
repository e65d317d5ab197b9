// Wavefront OBJ meshes.
#pragma once

#include "host/scene/meshes/mesh_data.h"

#include <filesystem>
#include <string>

namespace parhelion {

/// All faces of the file as one mesh, cut into triangles as polygon.h says. `flip_v` turns the
/// texture's v into 1 - v. Materials and groups are not read, lines and points noted;
/// mesh_builder.h and obj_keywords.h say what is left out and what refused. Throws InputError
/// "<path>:<line>: ..." for what cannot be read, `place` standing for the asker.
MeshData load_obj(const std::filesystem::path& path, bool flip_v, const SourceLocation& place);

/// The same of a text at hand, called `name` in messages.
MeshData parse_obj(std::string text, bool flip_v, const std::string& name);

} // namespace parhelion
