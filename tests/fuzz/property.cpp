// What readers of meshes promise.
#include "property.h"

#include <cmath>

namespace parhelion::fuzz {

namespace {

template<class Vector>
bool is_finite(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

template<class Vectors>
bool all_finite(const Vectors& vectors) {
    for (const auto& v : vectors)
        if (!is_finite(v)) return false;
    return true;
}

void check_indices(const std::vector<glm::uvec3>& triangles, std::size_t vertices) {
    for (const glm::uvec3& t : triangles)
        for (int i = 0; i < 3; ++i)
            promise(t[i] < vertices, "a triangle uses a vertex that is not there");
}

} // namespace

void check_mesh(const Mesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    promise(mesh.triangles.empty() == mesh.positions.empty(), "vertices are used");
    promise(all_finite(mesh.positions), "positions are finite");
    promise(mesh.normals.empty() || mesh.normals.size() == vertices, "a normal a vertex, or none");
    promise(mesh.uvs.empty() || mesh.uvs.size() == vertices, "a uv a vertex, or none");
    for (const glm::dvec3& n : mesh.normals)
        promise(std::abs(glm::length(n) - 1.0) < 1e-9, "normals have unit length");
    check_indices(mesh.triangles, vertices);
}

void check_mesh_data(const MeshData& data) {
    const std::size_t vertices = data.positions.size();
    promise(all_finite(data.positions), "positions are finite");
    promise(all_finite(data.normals), "normals are finite");
    promise(data.normals.empty() || data.normals.size() == vertices, "a normal a vertex, or none");
    promise(data.uvs.empty() || data.uvs.size() == vertices, "a uv a vertex, or none");
    check_indices(data.triangles, vertices);
    for (const std::string& note : data.notes)
        check_message(note);
    std::vector<std::string> notes;
    check_mesh(make_mesh(data, {}, {"scene.xml", 1}, notes));
}

} // namespace parhelion::fuzz
