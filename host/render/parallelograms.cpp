// Pairs of triangles that together are one parallelogram: a lamp of two triangles is one light.
#include "host/render/parallelograms.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>

namespace parhelion {
namespace {

using Corners = std::array<glm::dvec3, 3>;

/// The corner of `triangle` that `other` does not have; -1 unless it is exactly one.
int own_corner(const Corners& triangle, const Corners& other) {
    int own = -1, count = 0;
    for (int i = 0; i < 3; i++)
        if (std::find(other.begin(), other.end(), triangle[i]) == other.end()) own = i, count++;
    return count == 1 ? own : -1;
}

Corners corners(const Mesh& mesh, std::size_t triangle, const SceneFrame& frame) {
    const glm::uvec3& t = mesh.triangles[triangle];
    auto rounded = [&](unsigned i) { return glm::vec3(frame.point(mesh.positions[i])); };
    return {rounded(t.x), rounded(t.y), rounded(t.z)};
}

/// Does the triangle's winding face the side of its vertex normals?
bool faces_normals(const Mesh& mesh, std::size_t triangle, const SceneFrame& frame) {
    if (mesh.normals.empty()) return true;
    const glm::uvec3& t = mesh.triangles[triangle];
    Corners p = corners(mesh, triangle, frame);
    glm::dvec3 sum = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    return glm::dot(sum, glm::cross(p[1] - p[0], p[2] - p[0])) >= 0.0;
}

} // namespace

std::optional<Parallelogram> parallelogram_of(const Corners& first, const Corners& second) {
    int own = own_corner(first, second), across = own_corner(second, first);
    if (own < 0 || across < 0) return {};
    const glm::dvec3 &a = first[own], &b = first[(own + 1) % 3], &c = first[(own + 2) % 3];
    const glm::dvec3& d = second[across];
    // Seen from the same side, the shared edge runs the other way in the second triangle.
    if (second[(across + 1) % 3] != c) return {};
    // Each coordinate has been rounded to 24 bits.
    glm::dvec3 largest = glm::max(glm::max(glm::abs(a), glm::abs(b)), glm::abs(c));
    glm::dvec3 gap = glm::abs(a + d - b - c);
    if (glm::any(glm::greaterThan(gap, 0x1p-22 * largest))) return {};
    return Parallelogram{a, b, c};
}

std::vector<bool> starts_parallelogram(const Mesh& mesh, const SceneFrame& frame) {
    std::vector<bool> starts(mesh.triangles.size());
    for (std::size_t i = 0; i + 1 < starts.size(); i++) {
        bool taken = i > 0 && starts[i - 1];
        starts[i] = !taken &&
                    parallelogram_of(corners(mesh, i, frame), corners(mesh, i + 1, frame)) &&
                    faces_normals(mesh, i, frame) == faces_normals(mesh, i + 1, frame);
    }
    return starts;
}

} // namespace parhelion
