// Mitsuba's own compressed mesh files (.serialized, versions 3 and 4).
#pragma once

#include "host/scene/meshes/mesh_data.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace parhelion {

struct SerializedMesh {
    MeshData mesh;
    bool face_normals = false; ///< the file asks for faceted shading
};

/// Mesh number `shape_index` (from 0) of the file. A mesh that claims more than 16 MiB and 64 times
/// its compressed bytes is refused before its memory is spent. Throws InputError.
SerializedMesh load_serialized(const std::filesystem::path& path, std::int64_t shape_index,
                               const SourceLocation& place);

/// The same of a file's bytes at hand, called `name` in messages.
SerializedMesh parse_serialized(std::string_view file, std::int64_t shape_index,
                                const std::string& name);

} // namespace parhelion
