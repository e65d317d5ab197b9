// Pairs of triangles that together are one parallelogram: a lamp of two triangles is one light.
#include "host/flatten/parallelograms.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>

namespace parhelion {
namespace {

/// The corner of `triangle` that `other` does not have; -1 unless it is exactly one.
int own_corner(const Corners& triangle, const Corners& other) {
    int own = -1, count = 0;
    for (int i = 0; i < 3; i++)
        if (std::find(other.begin(), other.end(), triangle[i]) == other.end()) own = i, count++;
    return count == 1 ? own : -1;
}

glm::dvec3 largest_of(const Corners& t) {
    return glm::max(glm::max(glm::abs(t[0]), glm::abs(t[1])), glm::abs(t[2]));
}

double largest_component(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// Does the triangle's winding face the side of its vertex normals?
bool faces_normals(const Mesh& mesh, std::size_t triangle, const Corners& p) {
    if (mesh.normals.empty()) return true;
    const glm::uvec3& t = mesh.triangles[triangle];
    glm::dvec3 sum = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    return glm::dot(sum, glm::cross(p[1] - p[0], p[2] - p[0])) >= 0.0;
}

/// Two triangles of a mesh, in places of the device.
bool are_parallelogram(const Mesh& mesh, std::size_t i, std::size_t j, const SceneFrame& frame) {
    if (is_tiny(mesh, i, frame) || is_tiny(mesh, j, frame)) return false;
    Corners first = rounded(corners_of(mesh, i, frame)),
            second = rounded(corners_of(mesh, j, frame));
    return parallelogram_of(first, second) &&
           faces_normals(mesh, i, first) == faces_normals(mesh, j, second);
}

} // namespace

Corners corners_of(const Mesh& mesh, std::size_t triangle, const SceneFrame& frame) {
    const glm::uvec3& t = mesh.triangles[triangle];
    return {frame.point(mesh.positions[t.x]), frame.point(mesh.positions[t.y]),
            frame.point(mesh.positions[t.z])};
}

Corners rounded(const Corners& c) {
    auto round = [](const glm::dvec3& v) { return glm::dvec3(glm::vec3(v)); };
    return {round(c[0]), round(c[1]), round(c[2])};
}

Corners edges_of(const Mesh& mesh, std::size_t triangle, const SceneFrame& frame) {
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::dvec3& a = mesh.positions[t.x];
    return {glm::dvec3(0.0), (mesh.positions[t.y] - a) * frame.scale,
            (mesh.positions[t.z] - a) * frame.scale};
}

double triangle_area(const Corners& c) {
    return 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
}

bool is_tiny(const Mesh& mesh, std::size_t triangle, const SceneFrame& frame) {
    double place = largest_component(largest_of(corners_of(mesh, triangle, frame)));
    Corners e = edges_of(mesh, triangle, frame);
    return largest_component(largest_of({e[1], e[2], e[2] - e[1]})) < 0x1p-12 * place;
}

std::optional<Parallelogram> parallelogram_of(const Corners& first, const Corners& second) {
    int own = own_corner(first, second), across = own_corner(second, first);
    if (own < 0 || across < 0) return {};
    const glm::dvec3 &a = first[own], &b = first[(own + 1) % 3], &c = first[(own + 2) % 3];
    const glm::dvec3& d = second[across];
    // Seen from the same side, the shared edge runs the other way in the second triangle.
    if (second[(across + 1) % 3] != c) return {};
    // Each coordinate has been rounded to 24 bits.
    glm::dvec3 largest = largest_of({a, b, c});
    glm::dvec3 gap = glm::abs(a + d - b - c);
    if (glm::any(glm::greaterThan(gap, 0x1p-22 * largest))) return {};
    return Parallelogram{a, b, c};
}

std::vector<bool> starts_parallelogram(const Mesh& mesh, const SceneFrame& frame) {
    std::vector<bool> starts(mesh.triangles.size());
    for (std::size_t i = 0; i + 1 < starts.size(); i++) {
        bool taken = i > 0 && starts[i - 1];
        starts[i] = !taken && are_parallelogram(mesh, i, i + 1, frame);
    }
    return starts;
}

} // namespace parhelion
