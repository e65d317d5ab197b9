// Where vertices and faces of every kind of mesh file meet: what all of them accept, leave out with
// a note, and refuse.
#include "host/scene/meshes/mesh_builder.h"

#include "host/scene/meshes/polygon.h"
#include "host/scene/text.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace parhelion {

namespace {

bool is_zero(const glm::dvec3& v) { return v == glm::dvec3(0.0); }

/// The entries of `values` at which `keep` is set, in memory of their size.
template<typename T>
std::vector<T> kept(const std::vector<T>& values, const std::vector<bool>& keep,
                    std::size_t count) {
    std::vector<T> result;
    if (values.empty()) return result;
    result.reserve(count);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (keep[i]) result.push_back(values[i]);
    return result;
}

/// A crossing's attribute: zero, for "not there", where one of its corners has none.
glm::dvec3 blended_normal(const std::vector<glm::dvec3>& normals,
                          const std::array<std::uint32_t, 4>& v,
                          const std::array<double, 4>& weights) {
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < 4; ++k) {
        if (is_zero(normals[v[k]])) return glm::dvec3(0.0);
        sum += normals[v[k]] * weights[k];
    }
    return sum;
}

template<typename V>
V blended(const std::vector<V>& values, const std::array<std::uint32_t, 4>& v,
          const std::array<double, 4>& weights) {
    V sum(0.0);
    for (std::size_t k = 0; k < 4; ++k)
        sum += values[v[k]] * weights[k];
    return sum;
}

/// The attribute of one vertex more.
void blend(MeshAttribute& attribute, const std::array<std::uint32_t, 4>& v,
           const std::array<double, 4>& weights) {
    const auto channels = static_cast<std::size_t>(attribute.channels);
    for (std::size_t c = 0; c < channels; ++c) {
        double sum = 0.0;
        for (std::size_t k = 0; k < 4; ++k)
            sum += double{attribute.values[v[k] * channels + c]} * weights[k];
        attribute.values.push_back(static_cast<float>(sum));
    }
}

/// The values of vertices at which `keep` is set.
void keep_values(MeshAttribute& attribute, const std::vector<bool>& keep) {
    const auto channels = static_cast<std::size_t>(attribute.channels);
    std::size_t to = 0;
    for (std::size_t i = 0; i < keep.size(); ++i)
        for (std::size_t c = 0; keep[i] && c < channels; ++c)
            attribute.values[to++] = attribute.values[i * channels + c];
    attribute.values.resize(to);
}

bool has_no_area(const MeshData& mesh, std::size_t first_triangle) {
    for (std::size_t i = first_triangle; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        const glm::dvec3& a = mesh.positions[t[0]];
        if (!is_zero(glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a))) return false;
    }
    return true;
}

} // namespace

glm::dvec3 normal_in_file(const glm::dvec3& normal) {
    return is_zero(normal) ? glm::dvec3(std::numeric_limits<double>::quiet_NaN()) : normal;
}

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void MeshBuilder::note_count(std::size_t count, const std::string& one, const std::string& many,
                             const std::string& rest) {
    if (count > 0) note(std::to_string(count) + " " + (count == 1 ? one : many) + rest);
}

void MeshBuilder::add_face(std::span<const std::uint32_t> corners, const SourceLocation& place) {
    if (corners.size() < 3) {
        ++small_faces_;
        return;
    }
    for (const std::uint32_t corner : corners) {
        if (corner >= mesh.positions.size())
            refuse(place, "a face uses vertex " + std::to_string(corner) + " of " +
                              std::to_string(mesh.positions.size()) + " (counted from 0)");
        if (!is_finite(mesh.positions[corner]))
            refuse(place, "a face uses vertex " + std::to_string(corner) +
                              " (counted from 0), whose position is not finite");
    }
    const std::size_t first = mesh.triangles.size();
    if (corners.size() == 3)
        mesh.triangles.emplace_back(corners[0], corners[1], corners[2]);
    else
        add_polygon(corners, place);
    flat_faces_ += has_no_area(mesh, first);
}

void MeshBuilder::add_polygon(std::span<const std::uint32_t> corners, const SourceLocation& place) {
    std::vector<glm::dvec3> positions;
    positions.reserve(corners.size());
    for (const std::uint32_t corner : corners)
        positions.push_back(mesh.positions[corner]);
    const PolygonTriangles cut = triangulate(positions);
    if (cut.tangled)
        refuse(place, "a face of " + std::to_string(corners.size()) +
                          " corners whose outline crosses itself too often");
    std::vector<std::uint32_t> vertices(corners.begin(), corners.end());
    for (const CrossingCorner& crossing : cut.crossings) {
        std::array<std::uint32_t, 4> ends{};
        std::transform(crossing.corners.begin(), crossing.corners.end(), ends.begin(),
                       [&](std::uint32_t corner) { return vertices[corner]; });
        vertices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(blended(mesh.positions, ends, crossing.weights));
        if (!mesh.uvs.empty()) mesh.uvs.push_back(blended(mesh.uvs, ends, crossing.weights));
        if (!mesh.normals.empty())
            mesh.normals.push_back(blended_normal(mesh.normals, ends, crossing.weights));
        for (MeshAttribute& attribute : mesh.attributes)
            if (!attribute.of_faces()) blend(attribute, ends, crossing.weights);
    }
    for (const glm::uvec3& t : cut.triangles)
        mesh.triangles.emplace_back(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
}

void MeshBuilder::drop_unused_vertices() {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            used[t[i]] = true;
    const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
    if (count == used.size()) return;
    std::vector<std::uint32_t> moved(used.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < used.size(); ++i)
        moved[i] = used[i] ? next++ : 0;
    for (glm::uvec3& t : mesh.triangles)
        t = {moved[t[0]], moved[t[1]], moved[t[2]]};
    mesh.positions = kept(mesh.positions, used, count);
    mesh.normals = kept(mesh.normals, used, count);
    mesh.uvs = kept(mesh.uvs, used, count);
    for (MeshAttribute& attribute : mesh.attributes)
        if (!attribute.of_faces()) keep_values(attribute, used);
}

void MeshBuilder::drop_unusable_attributes() {
    std::size_t normals = 0, uvs = 0;
    for (glm::dvec3& n : mesh.normals)
        if (!is_finite(n)) {
            n = glm::dvec3(0.0);
            ++normals;
        }
    for (glm::dvec2& uv : mesh.uvs)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
            uv = glm::dvec2(0.0);
            ++uvs;
        }
    if (std::all_of(mesh.normals.begin(), mesh.normals.end(), is_zero)) mesh.normals.clear();
    note_count(normals, "vertex normal is", "vertex normals are",
               " zero or not finite; computed ones are used there");
    note_count(uvs, "texture coordinate is", "texture coordinates are", " not finite; 0 is used");
}

MeshData MeshBuilder::finish() && {
    drop_unused_vertices();
    drop_unusable_attributes();
    note_count(small_faces_, "face has", "faces have", " fewer than three corners; left out");
    note_count(flat_faces_, "face has", "faces have", " no area and cannot be seen");
    return std::move(mesh);
}

} // namespace parhelion
