// Shapes: geometry in world space (transforms are already applied), its materials and its light.
#pragma once

#include "host/error.h"
#include "host/scene/material.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace parhelion {

/// Numbers that a mesh has at its vertices, or of each of its triangles.
struct MeshAttribute {
    std::string name; ///< begins with "vertex_" or "face_"
    int channels = 3; ///< 1 or 3
    std::vector<float> values;

    bool of_faces() const { return name.starts_with("face_"); }
};

/// Triangles with shared vertices, each used by some. `normals` and `uvs` are empty or as long as
/// `positions`. `flip_normals` is applied on loading (winding and vertex normals), `face_normals`
/// drops the vertex normals.
struct Mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals; ///< unit length
    std::vector<glm::dvec2> uvs;
    std::vector<glm::uvec3>
        triangles; ///< counter-clockwise seen from the side the geometric normal points to
    std::vector<MeshAttribute> attributes; ///< those that textures name
};

/// Analytic sphere. The axes (unit, orthogonal, right-handed up to a mirror) carry the uv
/// parametrisation.
struct Sphere {
    glm::dvec3 center{0.0};
    double radius = 1.0;
    glm::dvec3 axis_x{1, 0, 0}, axis_y{0, 1, 0}, axis_z{0, 0, 1};
    bool flip_normals = false; ///< the normal points to the centre
};

/// Analytic disk { center + a*edge_u + b*edge_v : a^2 + b^2 <= 1 }; an ellipse where the edges are
/// not orthogonal and equally long. The normal is along cross(edge_u, edge_v), reversed by
/// `flip_normals`.
struct Disk {
    glm::dvec3 center{0.0};
    glm::dvec3 edge_u{1, 0, 0}, edge_v{0, 1, 0};
    bool flip_normals = false;
};

/// Analytic cylinder without caps about the line from `base` to `base + axis`. `side`, across the
/// axis and as long as the radius, is where the uv parametrisation begins; it goes round the axis
/// counter-clockwise, seen from its end, or the other way where the shape is mirrored. The normal
/// points away from the axis.
struct Cylinder {
    glm::dvec3 base{0.0};
    glm::dvec3 axis{0, 0, 1}, side{1, 0, 0};
    bool mirrored = false;
    bool flip_normals = false; ///< the normal points to the axis
};

using Geometry = std::variant<Mesh, Sphere, Disk, Cylinder>;

struct Shape {
    std::string id;
    std::string plugin; ///< "obj", "sphere", ...
    SourceLocation location;
    Geometry geometry;
    /// What its sides are made of (material.h); the front is that which the normal points to.
    /// `twosided` gives the back a material; otherwise it is that of the front for BSDFs that look
    /// at both sides themselves (dielectrics, null) and `no_material` for the rest.
    int material_front = no_material, material_back = no_material;
    std::optional<Rgb> radiance;   ///< area emitter on the front side, W/(m^2 sr)
    TextureUse radiance_texture{}; ///< tells it in the place of that value, 1
    std::string bsdf_id{};         ///< of the bsdf that stands in it
    std::string emitter_id{};      ///< "" for one without
};

} // namespace parhelion
