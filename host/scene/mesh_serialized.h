// Mitsuba's own compressed mesh files (.serialized, versions 3 and 4).
#pragma once

#include "host/scene/mesh_data.h"

#include <filesystem>

namespace parhelion {

struct SerializedMesh {
    MeshData mesh;
    bool face_normals = false; ///< the file asks for faceted shading
};

/// Mesh number `shape_index` (from 0) of the file. Throws InputError.
SerializedMesh load_serialized(const std::filesystem::path& path, std::int64_t shape_index,
                               const SourceLocation& place);

} // namespace parhelion
