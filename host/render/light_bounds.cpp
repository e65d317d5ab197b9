// What the light tree knows of each row of the light table.
#include "host/render/light_bounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <initializer_list>

namespace parhelion {
namespace {

constexpr double beyond_quarter_turn = 0.0, at_once = 1.0; // cosines of the angle of emission

glm::dvec3 point_a(const LightRecord& l) { return {l.ax, l.ay, l.az}; }
glm::dvec3 point_b(const LightRecord& l) { return {l.bx, l.by, l.bz}; }
glm::dvec3 point_c(const LightRecord& l) { return {l.cx, l.cy, l.cz}; }

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

} // namespace

LightBounds light_bounds(const LightRecord& l, double area, double power) {
    double brightness = double{l.r} + l.g + l.b;
    glm::dvec3 a = point_a(l), b = point_b(l), c = point_c(l);
    LightBounds bounds;
    bounds.power = power;
    switch (l.kind) {
    case emitter_area_triangle:
        set_box(bounds, {a, b, c});
        set_plane(bounds, glm::cross(b - a, c - a), area, brightness);
        break;
    case emitter_area_parallelogram:
        set_box(bounds, {a, b, c, b + c - a});
        set_plane(bounds, glm::cross(b - a, c - a), area, brightness);
        break;
    case emitter_area_disk: {
        glm::dvec3 reach = glm::sqrt(b * b + c * c);
        set_box(bounds, {a - reach, a + reach});
        set_plane(bounds, glm::cross(b, c) * double{l.extra}, area, brightness);
        break;
    }
    case emitter_area_sphere:
        set_box(bounds, {a - double{l.bx}, a + double{l.bx}});
        // Its disk as seen from outside; all of it from inside.
        set_everywhere(bounds, brightness * (l.extra > 0.0f ? 0.25 * area : area));
        break;
    case emitter_point:
        set_box(bounds, {a});
        set_everywhere(bounds, brightness);
        break;
    case emitter_spot: // as bright within its cutoff as on the axis, at most
        set_box(bounds, {a});
        bounds.axis = b;
        bounds.cos_spread = l.cx;
        bounds.cos_emission = at_once;
        bounds.intensity = brightness;
        break;
    default:
        bounds.distant = true;
    }
    return bounds;
}

} // namespace parhelion
