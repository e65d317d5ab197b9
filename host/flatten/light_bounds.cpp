// What the light tree knows of each row of the light table.
#include "host/flatten/light_bounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace parhelion {
namespace {

constexpr double beyond_quarter_turn = 0.0, at_once = 1.0; // cosines of the angle of emission

void set_box(LightBounds& b, std::initializer_list<glm::dvec3> points) {
    b.low = b.high = *points.begin();
    for (const glm::dvec3& p : points)
        b.low = glm::min(b.low, p), b.high = glm::max(b.high, p);
}

/// A plane surface: Lambert's law about its normal.
void set_plane(LightBounds& b, const glm::dvec3& normal, double area, double radiance) {
    if (double length = glm::length(normal); length > 0.0) b.axis = normal / length;
    b.cos_emission = beyond_quarter_turn;
    b.intensity = area * radiance;
}

void set_everywhere(LightBounds& b, double intensity) {
    b.cos_spread = -1.0;
    b.cos_emission = beyond_quarter_turn;
    b.intensity = intensity;
}

/// As bright all over its frame as on average.
void set_frame(LightBounds& b, const LightRow& row) {
    double half = 0.5 / glm::length(row.c), other = half / std::fabs(row.extra);
    double seen = 4.0 * std::asin(half * other / (std::hypot(1.0, half) * std::hypot(1.0, other)));
    b.axis = row.b;
    b.cos_spread = 1.0 / std::hypot(1.0, std::hypot(half, other));
    b.cos_emission = at_once;
    b.intensity = b.power / seen;
}

} // namespace

LightBounds light_bounds(const LightRow& row) {
    double bright = brightness(row.radiance);
    const glm::dvec3 &a = row.a, &b = row.b, &c = row.c;
    LightBounds bounds;
    bounds.power = power(row);
    switch (row.kind) {
    case emitter_area_triangle:
        set_box(bounds, {a, b, c});
        set_plane(bounds, glm::cross(b - a, c - a), row.area, bright);
        break;
    case emitter_area_parallelogram:
        set_box(bounds, {a, b, c, b + c - a});
        set_plane(bounds, glm::cross(b - a, c - a), row.area, bright);
        break;
    case emitter_area_tiny_triangle:
        set_box(bounds, {a, a + b, a + c});
        set_plane(bounds, glm::cross(b, c), row.area, bright);
        break;
    case emitter_area_disk: {
        glm::dvec3 reach = glm::sqrt(b * b + c * c);
        set_box(bounds, {a - reach, a + reach});
        set_plane(bounds, glm::cross(b, c) * row.extra, row.area, bright);
        break;
    }
    case emitter_area_sphere:
        set_box(bounds, {a - b.x, a + b.x});
        // Its disk as seen from outside; all of it from inside.
        set_everywhere(bounds, bright * (row.extra > 0.0 ? 0.25 * row.area : row.area));
        break;
    case emitter_area_cylinder:
        set_box(bounds, {a - c.x, a + c.x, a + b - c.x, a + b + c.x});
        // Its rectangle as seen from the side; all of it from inside.
        set_everywhere(bounds, bright * (row.extra > 0.0 ? row.area / std::numbers::pi : row.area));
        break;
    case emitter_point:
        set_box(bounds, {a});
        set_everywhere(bounds, bright);
        break;
    case emitter_spot: // as bright within its cutoff as on the axis, at most
        set_box(bounds, {a});
        bounds.axis = b;
        bounds.cos_spread = c.x;
        bounds.cos_emission = at_once;
        bounds.intensity = bright;
        break;
    case emitter_projector:
        set_box(bounds, {a});
        set_frame(bounds, row);
        break;
    case emitter_directional:
        bounds.distant = true;
        bounds.intensity = bright;
        break;
    default: // a sky: half of it is seen, as bright as on average
        bounds.distant = true;
        bounds.intensity = std::numbers::pi * bright * row.mean;
    }
    return bounds;
}

} // namespace parhelion
