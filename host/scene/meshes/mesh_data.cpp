// A mesh as its file holds it, and what turns it into a Mesh of the scene.
#include "host/scene/meshes/mesh_data.h"

#include "host/scene/text.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace parhelion {

namespace {

double largest_component(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Finite, and so is its difference to any other such vector.
bool is_in_range(const glm::dvec3& v) {
    constexpr double largest = std::numeric_limits<double>::max() / 2.0;
    return std::abs(v.x) <= largest && std::abs(v.y) <= largest && std::abs(v.z) <= largest;
}

bool is_zero(const glm::dvec3& v) { return v == glm::dvec3(0.0); }

/// Unit vector, safe for lengths whose square leaves the range of double.
glm::dvec3 direction_of(const glm::dvec3& v) {
    const double largest = largest_component(v);
    return largest > 0.0 ? glm::normalize(v / largest) : glm::dvec3(0.0);
}

glm::dvec3 geometric_normal(const Mesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a = mesh.positions[t[0]];
    const glm::dvec3 b = mesh.positions[t[1]] - a, c = mesh.positions[t[2]] - a;
    const glm::dvec3 normal = glm::cross(b, c);
    // Products of huge edges overflow, those of tiny ones lose digits.
    const double largest = largest_component(normal);
    if (largest > 0x1p-900 && std::isfinite(glm::dot(normal, glm::dvec3(1.0))))
        return direction_of(normal);
    return direction_of(glm::cross(direction_of(b), direction_of(c)));
}

/// Angle between unit vectors, accurate when they are nearly parallel (Kahan).
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));
}

/// What the faces around a vertex say about its normal.
struct NormalSum {
    glm::dvec3 sum{0.0};
    double weight = 0.0; ///< of all terms
    unsigned terms = 0;
    glm::dvec3 last{0.0}; ///< the normal of one of the faces

    void add(const glm::dvec3& normal, double angle) {
        sum += normal * angle;
        weight += angle;
        ++terms;
        last = normal;
    }

    /// Faces that cancel out leave nothing but the rounding of the sum, which is no direction.
    bool cancels() const {
        const double rounding = (terms + 2.0) * std::numeric_limits<double>::epsilon() * weight;
        return terms > 0 && glm::length(sum) <= rounding;
    }

    /// A vertex of degenerate triangles only is never seen; any unit vector will do there.
    glm::dvec3 normal() const {
        if (terms == 0) return {0, 0, 1};
        return cancels() ? last : direction_of(sum);
    }
};

std::vector<NormalSum> sum_normals(const Mesh& mesh) {
    std::vector<NormalSum> sums(mesh.positions.size());
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 n = geometric_normal(mesh, t);
        if (is_zero(n)) continue;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 p = mesh.positions[t[i]];
            const glm::dvec3 d0 = direction_of(mesh.positions[t[(i + 1) % 3]] - p);
            const glm::dvec3 d1 = direction_of(mesh.positions[t[(i + 2) % 3]] - p);
            sums[t[i]].add(n, angle_between(d0, d1));
        }
    }
    return sums;
}

/// Fills the zero entries of `mesh.normals`; returns how many have no average to go by.
std::size_t fill_normals(Mesh& mesh) {
    if (std::none_of(mesh.normals.begin(), mesh.normals.end(), is_zero)) return 0;
    const std::vector<NormalSum> sums = sum_normals(mesh);
    std::size_t cancelled = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (!is_zero(mesh.normals[i])) continue;
        mesh.normals[i] = sums[i].normal();
        cancelled += sums[i].cancels();
    }
    return cancelled;
}

/// Turns triangles so that their vertex normals point to the front.
void orient_by_normals(Mesh& mesh) {
    for (glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 shading = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
        if (glm::dot(geometric_normal(mesh, t), shading) < 0.0) std::swap(t[1], t[2]);
    }
}

void flip(Mesh& mesh) {
    for (glm::uvec3& t : mesh.triangles)
        std::swap(t[1], t[2]);
    for (glm::dvec3& n : mesh.normals)
        n = -n;
}

} // namespace

glm::dmat3 normal_matrix(const glm::dmat4& to_world) {
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        largest = std::max(largest, largest_component(glm::dvec3(to_world[column])));
    // A power of two, which rounds nothing, keeps products of huge and of tiny columns in range.
    const double scale = largest > 0.0 ? std::exp2(-std::logb(largest)) : 1.0;
    const glm::dmat3 m = glm::dmat3(to_world) * scale;
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                               glm::cross(m[0], m[1]));
    return glm::dot(m[0], cofactors[0]) < 0.0 ? -cofactors : cofactors;
}

Mesh make_mesh(MeshData data, const MeshOptions& options, const SourceLocation& place,
               std::vector<std::string>& notes) {
    for (const std::string& note : data.notes)
        notes.push_back(place.to_string() + ": " + note);
    if (data.triangles.empty())
        notes.push_back(place.to_string() + ": the mesh holds no triangle; it is not drawn");
    Mesh mesh{std::move(data.positions),
              {},
              std::move(data.uvs),
              std::move(data.triangles),
              std::move(data.attributes)};
    for (glm::dvec3& p : mesh.positions) {
        p = glm::dvec3(options.to_world * glm::dvec4(p, 1.0));
        if (!is_in_range(p)) refuse(place, "a vertex leaves the range of numbers under to_world");
    }
    if (!options.face_normals) {
        const glm::dmat3 to_world = normal_matrix(options.to_world);
        mesh.normals = std::move(data.normals);
        for (glm::dvec3& n : mesh.normals)
            n = direction_of(to_world * direction_of(n));
        const bool from_file = !mesh.normals.empty();
        mesh.normals.resize(mesh.positions.size(), glm::dvec3(0.0));
        const std::size_t cancelled = fill_normals(mesh);
        if (cancelled > 0)
            notes.push_back(place.to_string() + ": " + std::to_string(cancelled) +
                            " vertices have no defined smooth normal; one of their faces' is used");
        if (from_file) orient_by_normals(mesh);
    }
    if (options.flip_normals) flip(mesh);
    return mesh;
}

} // namespace parhelion
