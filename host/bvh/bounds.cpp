// Boxes of triangles, spheres, cylinders and disks.
#include "host/bvh/bounds.h"

#include "kernels/shared/features.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace parhelion {
namespace {

struct Interval {
    float low, high;
};

constexpr float infinite = std::numeric_limits<float>::infinity();

Interval triangle_extent(float a, float b, float c) {
    return {std::min({a, b, c}), std::max({a, b, c})};
}

/// The floats next to centre -+ reach, outward: the conversion to float may round inward by half a
/// unit.
Interval outward(float centre, double reach) {
    return {std::nextafter(float(centre - reach), -infinite),
            std::nextafter(float(centre + reach), infinite)};
}

/// The point of { a u + b v : a^2 + b^2 <= 1 } farthest along an axis is sqrt(u^2 + v^2) away, u
/// and v along that axis.
Interval disk_extent(float centre, float u, float v) {
    return outward(centre, std::sqrt(double(u) * u + double(v) * v));
}

/// Between circles of the radius about both ends of the axis; `share`: of the axis, along it.
Interval cylinder_extent(float base, float axis, float radius, double share) {
    double reach = std::fabs(double(radius)) * std::sqrt(std::max(0.0, 1.0 - share * share));
    double end = double(base) + axis;
    return {std::nextafter(float(std::min(double(base), end) - reach), -infinite),
            std::nextafter(float(std::max(double(base), end) + reach), infinite)};
}

std::array<Interval, 3> extents(const PrimitiveRecord& p) {
    switch (geometry_kind(p)) {
    case geometry_sphere: {
        double radius = std::fabs(p.extra);
        return {outward(p.ax, radius), outward(p.ay, radius), outward(p.az, radius)};
    }
    case geometry_cylinder: {
        glm::dvec3 share = glm::normalize(glm::dvec3(p.bx, p.by, p.bz));
        return {cylinder_extent(p.ax, p.bx, p.extra, share.x),
                cylinder_extent(p.ay, p.by, p.extra, share.y),
                cylinder_extent(p.az, p.bz, p.extra, share.z)};
    }
    case geometry_disk:
        return {disk_extent(p.ax, p.bx, p.cx), disk_extent(p.ay, p.by, p.cy),
                disk_extent(p.az, p.bz, p.cz)};
    default:
        return {triangle_extent(p.ax, p.bx, p.cx), triangle_extent(p.ay, p.by, p.cy),
                triangle_extent(p.az, p.bz, p.cz)};
    }
}

double longest_side(const std::array<Interval, 3>& box) {
    double longest = 0;
    for (const Interval& i : box)
        longest = std::max(longest, double(i.high) - i.low);
    return longest;
}

/// Larger by so much on both sides, and rounded outward.
Interval widened(Interval i, double margin) {
    constexpr double most = std::numeric_limits<float>::max();
    return {std::nextafter(float(std::max(i.low - margin, -most)), -infinite),
            std::nextafter(float(std::min(i.high + margin, most)), infinite)};
}

} // namespace

float longest_side(const PrimitiveRecord& p) { return float(longest_side(extents(p))); }

bool can_be_hit(const PrimitiveRecord& p) {
    if (geometry_kind(p) == geometry_cylinder)
        return glm::dvec3(p.bx, p.by, p.bz) != glm::dvec3(0.0);
    if (geometry_kind(p) != geometry_triangle) return true;
    glm::dvec3 a(p.ax, p.ay, p.az);
    return glm::cross(glm::dvec3(p.bx, p.by, p.bz) - a, glm::dvec3(p.cx, p.cy, p.cz) - a) !=
           glm::dvec3(0.0);
}

Reference make_reference(const PrimitiveRecord& primitive, int number, float side) {
    std::array<Interval, 3> e = extents(primitive);
    double longest = longest_side(e);
    if (geometry_kind(primitive) != geometry_triangle || longest > side)
        for (Interval& i : e)
            i = widened(i, longest * double(BOX_MARGIN));
    Float4 low = {e[0].low, e[1].low, e[2].low, hide_integer(number)};
    Float4 high = {e[0].high, e[1].high, e[2].high, hide_integer(geometry_kind(primitive))};
    return {{low, high}};
}

} // namespace parhelion
