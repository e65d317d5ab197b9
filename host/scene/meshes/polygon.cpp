// Faces of more than three corners: which triangles cover them.
#include "host/scene/meshes/polygon.h"

#include "host/scene/meshes/polygon_pieces.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace parhelion {

namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon() / 2.0;

/// The corners relative to the first, scaled by a power of two to at most 2 in each coordinate.
std::vector<glm::dvec3> scaled(std::span<const glm::dvec3> corners) {
    std::vector<glm::dvec3> result;
    result.reserve(corners.size());
    double largest = 0.0;
    for (const glm::dvec3& p : corners) {
        result.push_back(p - corners[0]);
        for (int i = 0; i < 3; ++i)
            largest = std::max(largest, std::abs(result.back()[i]));
    }
    if (!(largest > 0.0) || !std::isfinite(largest)) return {};
    const int exponent = -std::ilogb(largest);
    for (glm::dvec3& p : result)
        for (int i = 0; i < 3; ++i)
            p[i] = std::scalbn(p[i], exponent);
    return result;
}

/// Newell's normal; for an outline whose parts cancel (a bow tie) that of a large triangle of its
/// corners; zero where all lie in one line.
glm::dvec3 normal_of(const std::vector<glm::dvec3>& q) {
    glm::dvec3 sum(0.0);
    double terms = 0.0;
    for (std::size_t i = 1; i + 1 < q.size(); ++i) {
        sum += glm::cross(q[i], q[i + 1]);
        terms += glm::length(q[i]) * glm::length(q[i + 1]);
    }
    if (glm::length(sum) > 4.0 * static_cast<double>(q.size()) * rounding * terms) return sum;
    const auto longer = [](const auto& a, const auto& b) {
        return glm::dot(a, a) < glm::dot(b, b);
    };
    const glm::dvec3 far = *std::max_element(q.begin(), q.end(), longer);
    glm::dvec3 best(0.0);
    for (const glm::dvec3& p : q)
        best = std::max(best, glm::cross(far, p), longer);
    return glm::length(best) > 16.0 * rounding * glm::dot(far, far) ? best : glm::dvec3(0.0);
}

/// All triangles of the fan face the front, within rounding, and turn once at most.
bool fan_covers(const std::vector<glm::dvec2>& p) {
    double turned = 0.0;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
        const glm::dvec2 a = p[i] - p[0], b = p[i + 1] - p[0];
        if (i > 1 && a == glm::dvec2(0.0)) return false; // the outline comes back here
        const double area = a.x * b.y - a.y * b.x;
        // Flattened coordinates are at most 4 and off by 8 roundings.
        const double error =
            32.0 * rounding * (std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y));
        if (area < -error) return false;
        turned += std::atan2(std::max(area, 0.0), glm::dot(a, b));
    }
    return turned < 2.0 * std::numbers::pi;
}

PolygonTriangles fan(std::size_t corners) {
    PolygonTriangles result;
    for (std::uint32_t i = 2; i < corners; ++i)
        result.triangles.emplace_back(0u, i - 1, i);
    return result;
}

/// The corners seen along `n`, onto the plane of two axes: the outline keeps its shape up to an
/// affine map, and coordinates of a face in that plane keep every bit. The turn is kept.
std::vector<glm::dvec2> seen_along(const glm::dvec3& n, const std::vector<glm::dvec3>& q) {
    const glm::dvec3 size = glm::abs(n);
    const int c = size.z >= size.x && size.z >= size.y ? 2 : size.y >= size.x ? 1 : 0;
    int a = (c + 1) % 3, b = (c + 2) % 3;
    if (n[c] < 0.0) std::swap(a, b);
    std::vector<glm::dvec2> p;
    p.reserve(q.size());
    for (const glm::dvec3& v : q)
        p.emplace_back(v[a] - v[c] * (n[a] / n[c]), v[b] - v[c] * (n[b] / n[c]));
    return p;
}

/// Normal of the plane that fits the corners best (least squares), on the side of `normal`: by
/// power iteration, which need not be exact.
glm::dvec3 best_fit_normal(const std::vector<glm::dvec3>& q, const glm::dvec3& normal) {
    glm::dvec3 centre(0.0);
    for (const glm::dvec3& p : q)
        centre += p / static_cast<double>(q.size());
    glm::dmat3 spread(0.0);
    for (const glm::dvec3& p : q)
        spread += glm::outerProduct(p - centre, p - centre);
    const glm::dmat3 flipped = glm::dmat3(spread[0][0] + spread[1][1] + spread[2][2]) - spread;
    glm::dvec3 n = glm::normalize(normal);
    for (int i = 0; i < 64; ++i)
        n = glm::normalize(flipped * n);
    return n;
}

} // namespace

PolygonTriangles triangulate(std::span<const glm::dvec3> corners) {
    if (corners.size() < 4) return fan(corners.size());
    const std::vector<glm::dvec3> q = scaled(corners);
    const glm::dvec3 normal = q.empty() ? glm::dvec3(0.0) : normal_of(q);
    if (normal == glm::dvec3(0.0)) return fan(corners.size());
    const std::vector<glm::dvec2> points = seen_along(normal, q);
    if (fan_covers(points)) return fan(corners.size());
    PolygonTriangles result = cover_with_triangles(points);
    if (result.crossings.empty() && !result.tangled) return result;
    PolygonTriangles other = cover_with_triangles(seen_along(best_fit_normal(q, normal), q));
    const bool better =
        result.tangled || (!other.tangled && other.crossings.size() < result.crossings.size());
    return better ? other : result;
}

} // namespace parhelion
