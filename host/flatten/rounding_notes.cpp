// What single precision loses of shapes that are small for their place.
#include "host/flatten/rounding_notes.h"

#include "host/flatten/parallelograms.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace parhelion {
namespace {

constexpr double noted = 0.01;
constexpr double least_size = 0x1p-31; ///< device units: smaller ones have no area squared
constexpr std::size_t faces_measured = 4096;

double largest(const glm::dvec3& v) {
    glm::dvec3 a = glm::abs(v);
    return std::max({a.x, a.y, a.z});
}

/// What the device makes of a shape.
struct Rounded {
    double size;      ///< device units; 0: it has none, and nothing to lose
    double off = 0.0; ///< of its own size, or of its area
};

Rounded rounding_of(const Mesh& mesh, const SceneFrame& frame) {
    double exact = 0.0, off = 0.0, size = 0.0;
    std::size_t step = mesh.triangles.size() / faces_measured + 1;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += step) {
        Corners edges = edges_of(mesh, i, frame);
        double area = triangle_area(edges);
        exact += area;
        off += std::fabs(triangle_area(rounded(corners_of(mesh, i, frame))) - area);
        size = std::max({size, largest(edges[1]), largest(edges[2])});
    }
    return exact > 0.0 ? Rounded{size, off / exact} : Rounded{0.0};
}

Rounded rounding_of_place(const glm::dvec3& place, double size) {
    return size > 0.0 ? Rounded{size, 0x1p-24 * largest(place) / size} : Rounded{0.0};
}

Rounded rounding_of(const Sphere& in_scene, const SceneFrame& frame) {
    Sphere s = frame.sphere(in_scene);
    return rounding_of_place(s.center, s.radius);
}

Rounded rounding_of(const Disk& in_scene, const SceneFrame& frame) {
    Disk d = frame.disk(in_scene);
    return rounding_of_place(d.center, std::max(largest(d.edge_u), largest(d.edge_v)));
}

Rounded rounding_of(const Cylinder& in_scene, const SceneFrame& frame) {
    Cylinder c = frame.cylinder(in_scene);
    return rounding_of_place(glm::max(glm::abs(c.base), glm::abs(c.base + c.axis)),
                             glm::length(c.side));
}

} // namespace

std::vector<std::string> rounding_notes(const Scene& scene, const SceneFrame& frame) {
    std::vector<std::string> notes;
    for (const Shape& shape : scene.shapes) {
        Rounded r =
            std::visit([&](const auto& g) { return rounding_of(g, frame); }, shape.geometry);
        if (r.size == 0.0 || (r.size >= least_size && r.off < noted)) continue;
        notes.push_back(
            fmt::format("{}: {} '{}' is so small {} that single precision does not "
                        "keep its shape; what is seen of it is not right{}",
                        shape.location.to_string(), shape.plugin, shape.id,
                        r.off < noted ? "beside the scene" : "for its distance from the camera",
                        shape.radiance ? ", its light on other shapes is" : ""));
    }
    return notes;
}

} // namespace parhelion
