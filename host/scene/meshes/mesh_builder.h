// Where vertices and faces of every kind of mesh file meet: what all of them accept, leave out with
// a note, and refuse.
#pragma once

#include "host/scene/meshes/mesh_data.h"

#include <cstdint>
#include <span>
#include <string>

namespace parhelion {

/// A reader fills `mesh` with vertices as its file has them, numbers that are not finite among
/// them, and hands over the faces. What no face uses is dropped whatever it holds; of what one
/// uses, a position that is not finite is refused, a normal or texture coordinate left out.
class MeshBuilder {
public:
    explicit MeshBuilder(const std::string& file) : file_(file) {}

    MeshData mesh;

    /// A face of any number of corners. Fewer than three are no face: left out and counted. Throws
    /// InputError at `place` for corners that are not there or not finite.
    void add_face(std::span<const std::uint32_t> corners, const SourceLocation& place);

    void note(const std::string& text) { mesh.notes.push_back(file_ + ": " + text); }
    /// "<count> <one|many> ..."; nothing for a count of zero.
    void note_count(std::size_t count, const std::string& one, const std::string& many,
                    const std::string& rest);

    /// The mesh with the vertices that are used, in their order, and notes of what was left out.
    MeshData finish() &&;

private:
    void add_polygon(std::span<const std::uint32_t> corners, const SourceLocation& place);
    void drop_unused_vertices();
    void drop_unusable_attributes();

    std::string file_;
    std::size_t small_faces_ = 0, flat_faces_ = 0;
};

/// `normal`, or one that is not finite for a zero one: what a file has, but cannot be used.
/// MeshData::normals keeps zero for what a file does not have.
glm::dvec3 normal_in_file(const glm::dvec3& normal);

bool is_finite(const glm::dvec3& v);

} // namespace parhelion
