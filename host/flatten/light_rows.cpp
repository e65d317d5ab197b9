// Rows of the light table: one for every emitting primitive; those of other emitters behind them.
#include "host/flatten/light_rows.h"

#include "host/flatten/emitter_rows.h"
#include "host/flatten/light_groups.h"
#include "host/flatten/parallelograms.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace parhelion {
namespace {

constexpr double pi = std::numbers::pi;

// ---- surfaces, in the frame of the device

double rounded_inverse_normal(const glm::dvec3& u, const glm::dvec3& v) {
    return inverse_normal_length(glm::dvec3(glm::vec3(u)), glm::dvec3(glm::vec3(v)));
}

/// The side a triangle emits from is its shading normal's: the row's winding follows that.
Corners facing_emission(const Mesh& mesh, std::size_t triangle, const Corners& c) {
    if (mesh.normals.empty()) return c;
    const glm::uvec3& t = mesh.triangles[triangle];
    glm::dvec3 sum = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    bool turned = glm::dot(sum, glm::cross(c[1] - c[0], c[2] - c[0])) < 0.0;
    return turned ? Corners{c[0], c[2], c[1]} : c;
}

/// Of corners as the device's primitives have them, but of the area that they were meant to have.
LightRow corners_row(EmitterKind kind, const Corners& c, double area) {
    LightRow row;
    row.kind = kind;
    row.a = c[0], row.b = c[1], row.c = c[2];
    row.extra = inverse_normal_length(row.b - row.a, row.c - row.a);
    row.area = area;
    return row;
}

LightRow tiny_triangle_row(const glm::dvec3& corner, const Corners& edges) {
    LightRow row;
    row.kind = emitter_area_tiny_triangle;
    row.a = corner, row.b = edges[1], row.c = edges[2];
    row.extra = rounded_inverse_normal(row.b, row.c);
    row.area = triangle_area(edges);
    return row;
}

LightRow triangle_row(const Mesh& mesh, std::size_t triangle, const SceneFrame& frame) {
    Corners corners = corners_of(mesh, triangle, frame), edges = edges_of(mesh, triangle, frame);
    if (is_tiny(mesh, triangle, frame))
        return tiny_triangle_row(corners[0], facing_emission(mesh, triangle, edges));
    return corners_row(emitter_area_triangle, facing_emission(mesh, triangle, rounded(corners)),
                       triangle_area(edges));
}

/// The triangle and the next one, which together are a parallelogram.
LightRow parallelogram_row(const Mesh& mesh, std::size_t triangle, const SceneFrame& frame) {
    Corners shape = parallelogram_of(rounded(corners_of(mesh, triangle, frame)),
                                     rounded(corners_of(mesh, triangle + 1, frame)))
                        .value();
    double area = triangle_area(edges_of(mesh, triangle, frame)) +
                  triangle_area(edges_of(mesh, triangle + 1, frame));
    LightRow row =
        corners_row(emitter_area_parallelogram, facing_emission(mesh, triangle, shape), area);
    row.primitive_count = 2;
    return row;
}

std::vector<LightRow> rows_of(const Mesh& mesh, const SceneFrame& frame) {
    std::vector<LightRow> rows;
    std::vector<bool> pairs = starts_parallelogram(mesh, frame);
    for (std::size_t i = 0; i < pairs.size(); i += pairs[i] ? 2 : 1) {
        rows.push_back(pairs[i] ? parallelogram_row(mesh, i, frame) : triangle_row(mesh, i, frame));
        rows.back().first_primitive = static_cast<int>(i);
    }
    return rows;
}

double side_of(bool flip_normals) { return flip_normals ? -1.0 : 1.0; }

std::vector<LightRow> rows_of(const Sphere& in_scene, const SceneFrame& frame) {
    Sphere sphere = frame.sphere(in_scene);
    LightRow row;
    row.kind = emitter_area_sphere;
    row.a = sphere.center, row.b.x = sphere.radius;
    row.extra = side_of(sphere.flip_normals);
    row.area = 4.0 * pi * sphere.radius * sphere.radius;
    row.first_primitive = 0;
    return {row};
}

std::vector<LightRow> rows_of(const Disk& in_scene, const SceneFrame& frame) {
    Disk disk = frame.disk(in_scene);
    LightRow row;
    row.kind = emitter_area_disk;
    row.a = disk.center, row.b = disk.edge_u, row.c = disk.edge_v;
    row.extra = side_of(disk.flip_normals) * rounded_inverse_normal(disk.edge_u, disk.edge_v);
    row.area = pi * glm::length(glm::cross(disk.edge_u, disk.edge_v));
    row.first_primitive = 0;
    return {row};
}

std::vector<LightRow> rows_of(const Cylinder& in_scene, const SceneFrame& frame) {
    Cylinder cylinder = frame.cylinder(in_scene);
    double radius = glm::length(cylinder.side);
    LightRow row;
    row.kind = emitter_area_cylinder;
    row.a = cylinder.base, row.b = cylinder.axis, row.c.x = radius;
    row.extra = side_of(cylinder.flip_normals);
    row.area = 2.0 * pi * radius * glm::length(cylinder.axis);
    row.first_primitive = 0;
    return {row};
}

// ---- all of them

/// What is to be said of a shape whose light is lost, or part of it; nothing if none is.
void note_lost_light(const Shape& shape, std::span<const LightRow> rows,
                     std::vector<std::string>& notes) {
    auto flat = [](const LightRow& row) { return !(row.area > 0.0); };
    auto lost = [](const LightRow& row) {
        return row.area > 0.0 && row.area < double{std::numeric_limits<float>::min()};
    };
    if (!rows.empty() && std::all_of(rows.begin(), rows.end(), flat))
        notes.push_back(fmt::format("{}: {} '{}' emits, but has no area: it gives no light",
                                    shape.location.to_string(), shape.plugin, shape.id));
    if (std::any_of(rows.begin(), rows.end(), lost))
        notes.push_back(fmt::format("{}: {} '{}' emits, but is too small beside the scene for its "
                                    "light to be right",
                                    shape.location.to_string(), shape.plugin, shape.id));
}

std::vector<LightRow> rows_of(const Shape& shape, int texture, const DeviceScene& device,
                              int first_primitive, std::vector<std::string>& notes) {
    const SceneFrame& frame = device.frame;
    const Rgb radiance =
        texture < 0 ? *shape.radiance : device.texture_means[static_cast<std::size_t>(texture)];
    std::vector<LightRow> rows =
        std::visit([&](const auto& g) { return rows_of(g, frame); }, shape.geometry);
    for (LightRow& row : rows) {
        row.radiance = radiance;
        row.texture = texture;
        row.etendue = pi * row.area;
        row.first_primitive += first_primitive;
    }
    if (brightness(radiance) > 0.0) note_lost_light(shape, rows, notes);
    return rows;
}

} // namespace

std::vector<LightRow> light_rows(const Scene& scene, const DeviceScene& device,
                                 std::vector<std::string>& notes) {
    std::vector<LightRow> rows;
    int first = 0;
    for (std::size_t i = 0; i < scene.shapes.size(); i++) {
        const Shape& shape = scene.shapes[i];
        if (shape.radiance) {
            std::vector<LightRow> more =
                rows_of(shape, device.radiance_textures[i], device, first, notes);
            for (LightRow& row : more)
                row.group = group_of(scene.integrator.light_groups, {shape.emitter_id, shape.id});
            rows.insert(rows.end(), more.begin(), more.end());
        }
        first += static_cast<int>(primitive_count(shape));
    }
    std::vector<LightRow> apart = emitter_rows(scene, device);
    rows.insert(rows.end(), apart.begin(), apart.end());
    std::erase_if(rows, [](const LightRow& row) {
        return !(row.etendue > 0.0 && brightness(row.radiance) > 0.0);
    });
    return rows;
}

} // namespace parhelion
