// Triangle scenes made by code: what the ray sets are traced through and the trees are built over.
#pragma once

#include "host/bvh/geometry.h"
#include "kernels/shared/types.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace parhelion::bench {

struct Point {
    float x, y, z;
};

struct Triangle {
    std::uint32_t a, b, c;
};

struct TriangleMesh {
    std::vector<Point> vertices;
    std::vector<Triangle> triangles;
};

/// A mesh, a pinhole camera with a square picture, and a parallelogram of light that is no part of
/// the mesh.
struct TriangleScene {
    std::string name;
    TriangleMesh mesh;
    Point eye, target;
    double fov_degrees; ///< full angle
    Point light_corner, light_u, light_v;
};

/// Where Debian's glmark2-data has the bunny.
inline constexpr const char* bunny_file = "/usr/share/glmark2/models/bunny.obj";

/// The bunny in the middle of a closed room, lit from the ceiling: 70 k triangles. Throws
/// InputError where the mesh is not installed.
TriangleScene bunny_room();

/// A hall over hills, with 20 bunnies on the ground and 24 rocks in the air: about `triangles`
/// (0.5 M and more are met within 1 %), tessellated finer for more. 3.2 M is the large scene.
TriangleScene landscape(std::size_t triangles);

/// Hills and rocks alone, of about `triangles` triangles, for any number from a thousand on: what
/// the growth of a build is measured on.
TriangleMesh hills_and_rocks(std::size_t triangles);

std::vector<PrimitiveRecord> primitive_records(const TriangleMesh& mesh);

/// The same as a scene stores it.
IndexedGeometry indexed_geometry(const TriangleMesh& mesh);

} // namespace parhelion::bench
