// The table of lights: every emitting primitive and every other emitter, picked in proportion to
// power.
#include "host/render/light_table.h"

#include "host/error.h"
#include "host/render/light_bounds.h"
#include "host/render/parallelograms.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace parhelion {
namespace {

constexpr double pi = std::numbers::pi;

double brightness(const Rgb& c) { return c.r + c.g + c.b; }

glm::dvec3 point_a(const PrimitiveRecord& p) { return {p.ax, p.ay, p.az}; }
glm::dvec3 point_b(const PrimitiveRecord& p) { return {p.bx, p.by, p.bz}; }
glm::dvec3 point_c(const PrimitiveRecord& p) { return {p.cx, p.cy, p.cz}; }

void set_a(LightRecord& l, const glm::dvec3& v) {
    l.ax = static_cast<float>(v.x), l.ay = static_cast<float>(v.y), l.az = static_cast<float>(v.z);
}
void set_b(LightRecord& l, const glm::dvec3& v) {
    l.bx = static_cast<float>(v.x), l.by = static_cast<float>(v.y), l.bz = static_cast<float>(v.z);
}
void set_c(LightRecord& l, const glm::dvec3& v) {
    l.cx = static_cast<float>(v.x), l.cy = static_cast<float>(v.y), l.cz = static_cast<float>(v.z);
}

/// A row of the table in the making; power is in any common unit, area in the device's (0: no
/// area).
struct Row {
    LightRecord light{};
    double power = 0.0;
    double area = 0.0;
    int first_primitive = -1, primitive_count = 1; ///< that shine; -1: none does
};

Row make_row(EmitterKind kind, const Rgb& radiance) {
    Row row;
    row.light.kind = kind;
    row.light.r = static_cast<float>(radiance.r);
    row.light.g = static_cast<float>(radiance.g);
    row.light.b = static_cast<float>(radiance.b);
    return row;
}

/// The side a triangle emits from is its shading normal's: the record's winding follows that.
bool normals_oppose_winding(const VertexRecord& v, const glm::dvec3& winding) {
    glm::dvec3 sum(double{v.n0x} + v.n1x + v.n2x, double{v.n0y} + v.n1y + v.n2y,
                   double{v.n0z} + v.n1z + v.n2z);
    return glm::dot(sum, winding) < 0.0;
}

bool emits_from_back(const DeviceScene& scene, int triangle) {
    const PrimitiveRecord& p = scene.primitives[triangle];
    glm::dvec3 winding = glm::cross(point_b(p) - point_a(p), point_c(p) - point_a(p));
    return (p.flags & PRIMITIVE_NORMALS) && !scene.vertices.empty() &&
           normals_oppose_winding(scene.vertices[triangle], winding);
}

/// A light of corners a, b, c, turned over if `swap`; `area`: of the part of its plane that shines,
/// in areas of the triangle a, b, c.
Row corners_row(EmitterKind kind, const std::array<glm::dvec3, 3>& corners, bool swap, double area,
                const Rgb& radiance) {
    const auto& [a, b, c] = corners;
    Row row = make_row(kind, radiance);
    set_a(row.light, a);
    set_b(row.light, swap ? c : b);
    set_c(row.light, swap ? b : c);
    row.area = area * 0.5 * glm::length(glm::cross(b - a, c - a));
    row.light.extra = inverse_normal_length(b - a, c - a);
    return row;
}

std::array<glm::dvec3, 3> corners_of(const PrimitiveRecord& p) {
    return {point_a(p), point_b(p), point_c(p)};
}

Row triangle_row(const DeviceScene& scene, int index, const Rgb& radiance) {
    return corners_row(emitter_area_triangle, corners_of(scene.primitives[index]),
                       emits_from_back(scene, index), 1.0, radiance);
}

/// The triangle and the next one, which together are a parallelogram.
Row parallelogram_row(const DeviceScene& scene, int index, const Rgb& radiance) {
    auto shape = parallelogram_of(corners_of(scene.primitives[index]),
                                  corners_of(scene.primitives[index + 1]));
    Row row = corners_row(emitter_area_parallelogram, shape.value(), emits_from_back(scene, index),
                          2.0, radiance);
    row.primitive_count = 2;
    return row;
}

Row primitive_row(const DeviceScene& scene, int index, bool pair, const Rgb& radiance) {
    const PrimitiveRecord& p = scene.primitives[index];
    float side = (p.flags & PRIMITIVE_FLIPPED) ? -1.0f : 1.0f;
    Row row;
    switch (p.flags & PRIMITIVE_KIND_MASK) {
    case geometry_sphere:
        row = make_row(emitter_area_sphere, radiance);
        set_a(row.light, point_a(p));
        row.light.bx = p.extra;
        row.light.extra = side;
        row.area = 4.0 * pi * double{p.extra} * p.extra;
        break;
    case geometry_disk:
        row = make_row(emitter_area_disk, radiance);
        set_a(row.light, point_a(p));
        set_b(row.light, point_b(p));
        set_c(row.light, point_c(p));
        row.area = pi * glm::length(glm::cross(point_b(p), point_c(p)));
        row.light.extra = side * inverse_normal_length(point_b(p), point_c(p));
        break;
    default:
        row =
            pair ? parallelogram_row(scene, index, radiance) : triangle_row(scene, index, radiance);
    }
    row.power = pi * row.area * brightness(radiance);
    row.first_primitive = index;
    return row;
}

/// What rows of emitters that are no surfaces are made with.
struct Surroundings {
    const SceneFrame& frame;
    double radius; ///< of the scene, device units
};

Row emitter_row(const PointEmitter& e, const Surroundings& s) {
    Rgb intensity = s.frame.intensity(e.intensity);
    Row row = make_row(emitter_point, intensity);
    set_a(row.light, s.frame.point(e.position));
    row.power = 4.0 * pi * brightness(intensity);
    return row;
}

Row emitter_row(const SpotEmitter& e, const Surroundings& s) {
    Rgb intensity = s.frame.intensity(e.intensity);
    Row row = make_row(emitter_spot, intensity);
    set_a(row.light, s.frame.point(e.position));
    set_b(row.light, e.direction);
    row.light.cx = static_cast<float>(std::cos(e.cutoff_angle));
    row.light.cy = static_cast<float>(e.cutoff_angle);
    // With no transition the falloff is never evaluated: the two cosines meet.
    double transition = e.cutoff_angle - e.beam_width;
    row.light.cz = transition > 0.0 ? static_cast<float>(1.0 / transition) : 0.0f;
    row.light.extra = static_cast<float>(std::cos(e.beam_width));
    row.power =
        2.0 * pi * (1.0 - std::cos(0.5 * (e.cutoff_angle + e.beam_width))) * brightness(intensity);
    return row;
}

Row emitter_row(const DirectionalEmitter& e, const Surroundings& s) {
    Row row = make_row(emitter_directional, e.irradiance);
    set_b(row.light, e.direction);
    row.power = pi * s.radius * s.radius * brightness(e.irradiance);
    return row;
}

Row emitter_row(const ConstantEmitter& e, const Surroundings& s) {
    Row row = make_row(emitter_constant, e.radiance);
    row.power = 4.0 * pi * pi * s.radius * s.radius * brightness(e.radiance);
    return row;
}

/// Half the diagonal of the box around all primitives; 1 for a scene without any.
double scene_radius(std::span<const PrimitiveRecord> primitives) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()),
        high(-std::numeric_limits<double>::infinity());
    auto grow = [&](const glm::dvec3& p, double r) {
        low = glm::min(low, p - r), high = glm::max(high, p + r);
    };
    for (const PrimitiveRecord& p : primitives) {
        switch (p.flags & PRIMITIVE_KIND_MASK) {
        case geometry_sphere:
            grow(point_a(p), p.extra);
            break;
        case geometry_disk:
            grow(point_a(p), std::hypot(glm::length(point_b(p)), glm::length(point_c(p))));
            break;
        default:
            grow(point_a(p), 0.0), grow(point_b(p), 0.0), grow(point_c(p), 0.0);
        }
    }
    double radius = 0.5 * glm::length(high - low);
    return primitives.empty() || radius == 0.0 ? 1.0 : radius;
}

/// Intensities grow with the square of the scene's unit: what a scene file can say may be more than
/// single precision holds.
void check_range(const Row& row, const std::string& file) {
    for (float value : {row.light.r, row.light.g, row.light.b})
        if (std::isinf(value) && std::isfinite(row.power))
            throw InputError(fmt::format(
                "{}: a light of power {:.3g} in the unit that the scene is rendered in is too "
                "bright for single precision (accepted: radiance and intensity up to {:.3g} there)",
                file, row.power, std::numeric_limits<float>::max()));
}

std::vector<Row> collect_rows(const Scene& scene, const DeviceScene& device) {
    std::vector<Row> rows;
    int first = 0;
    for (const Shape& shape : scene.shapes) {
        const Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
        int count = static_cast<int>(primitive_count(shape));
        if (shape.radiance) {
            std::vector<bool> pairs =
                mesh ? starts_parallelogram(*mesh, device.frame) : std::vector{false};
            for (int i = 0; i < count; i += pairs[i] ? 2 : 1)
                rows.push_back(primitive_row(device, first + i, pairs[i], *shape.radiance));
        }
        first += count;
    }
    Surroundings around{device.frame, scene_radius(device.primitives)};
    for (const Emitter& emitter : scene.emitters)
        rows.push_back(std::visit([&](const auto& e) { return emitter_row(e, around); }, emitter));
    std::erase_if(rows, [](const Row& row) { return !(row.power > 0.0); });
    for (const Row& row : rows)
        check_range(row, scene.file);
    return rows;
}

} // namespace

void add_light_table(const Scene& scene, LightChoice choice, DeviceScene& out) {
    std::vector<Row> rows = collect_rows(scene, out);
    double total = 0.0;
    for (const Row& row : rows)
        total += row.power;
    // Only ratios of powers count. In units of a power of two near their sum, which changes no bit,
    // they are single-precision numbers however bright the lights are.
    int unit = rows.empty() ? 0 : std::ilogb(total);
    std::vector<LightBounds> bounds;
    for (const Row& row : rows) {
        LightBounds b = light_bounds(row.light, row.area, row.power);
        b.power = std::scalbn(b.power, -unit), b.intensity = std::scalbn(b.intensity, -unit);
        bounds.push_back(b);
    }
    for (std::size_t i = 0; i < rows.size(); i++) {
        Row& row = rows[i];
        double pmf = row.power / total;
        row.light.pmf = static_cast<float>(pmf);
        row.light.area = static_cast<float>(row.area);
        for (int k = 0; row.first_primitive >= 0 && k < row.primitive_count; k++)
            out.primitives[row.first_primitive + k].light = static_cast<int>(i);
        if (row.light.kind == emitter_constant) out.constant_light = static_cast<int>(i);
        out.lights.push_back(row.light);
    }
    out.light_tree = build_light_tree(bounds, choice);
}

} // namespace parhelion
