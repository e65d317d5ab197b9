// Stanford PLY meshes, text and binary.
#pragma once

#include "host/scene/meshes/mesh_data.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace parhelion {

/// Positions, normals (nx ny nz) and texture coordinates (u v, s t, or texture_u texture_v) of the
/// `vertex` element and the polygons of `face`, cut into triangles as polygon.h says. Other
/// properties are skipped with a note; mesh_builder.h says what else is left out and what refused.
/// `flip_v` turns v into 1 - v.
/// Throws InputError "<path>:<line>: ..." for what cannot be read, `place` standing for the asker.
MeshData load_ply(const std::filesystem::path& path, bool flip_v, const SourceLocation& place);

/// The same of a file's bytes at hand, called `name` in messages.
MeshData parse_ply(std::string_view file, bool flip_v, const std::string& name);

} // namespace parhelion
