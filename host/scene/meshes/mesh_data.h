// A mesh as its file holds it, and what turns it into a Mesh of the scene.
#pragma once

#include "host/scene/scene.h"

#include <glm/mat4x4.hpp>

#include <string>
#include <vector>

namespace parhelion {

/// Object space, as mesh_builder.h leaves it: numbers are finite, every vertex is used. `normals`
/// and `uvs` are empty or as long as `positions`; a zero normal says that the file has none for
/// that vertex. Indices are within range.
struct MeshData {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec2> uvs;
    std::vector<glm::uvec3> triangles;
    std::vector<MeshAttribute> attributes;
    std::vector<std::string> notes; ///< what was skipped
};

struct MeshOptions {
    glm::dmat4 to_world{1.0};
    bool face_normals = false; ///< drop vertex normals, computed ones too
    bool flip_normals = false;
};

/// Moves the mesh to world space. Without vertex normals in the file they are computed, weighted by
/// the angle at the vertex (Thuermer and Wuethrich 1998), unless `face_normals`. Where the file has
/// vertex normals they decide which side of a triangle is its front. A mesh without a triangle
/// stays one. Throws InputError at `place` for coordinates that overflow; adds to `notes`.
Mesh make_mesh(MeshData data, const MeshOptions& options, const SourceLocation& place,
               std::vector<std::string>& notes);

/// Inverse transpose of the upper 3x3 part up to a positive factor: what normals transform by.
glm::dmat3 normal_matrix(const glm::dmat4& to_world);

} // namespace parhelion
