// Wavefront OBJ meshes.
#pragma once

#include "host/scene/mesh_data.h"

#include <filesystem>
#include <string>

namespace parhelion {

/// All faces of the file as one mesh; polygons become fans around their first corner. `flip_v`
/// turns the texture's v into 1 - v. Materials, groups, lines and points are not read.
/// Throws InputError "<path>:<line>: ..." for what cannot be read, `place` standing for the asker.
MeshData load_obj(const std::filesystem::path& path, bool flip_v, const SourceLocation& place);

/// The same of a text at hand, called `name` in messages.
MeshData parse_obj(std::string text, bool flip_v, const std::string& name);

} // namespace parhelion
