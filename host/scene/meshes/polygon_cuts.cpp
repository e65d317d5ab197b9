// Cuts an outline at diagonals: from a corner a ray is sent inwards; of what lies in the triangle
// of the corner, the place of the hit and the end of the edge hit, the corner next to the ray is
// seen from the first one. Every diagonal is then tested with bounds on rounding, so that a wrong
// guess costs a try and nothing else.
#include "host/scene/meshes/polygon_pieces.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace parhelion {

namespace {

constexpr int tries = 24;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The side of the line a, b that c lies on: 1 left, -1 right, 0 where rounding may decide.
int side(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
    // Shewchuk's bound for the difference of the two products (3 + 16 u) u, rounded up.
    const double error =
        2.0 * std::numeric_limits<double>::epsilon() * (std::abs(left) + std::abs(right));
    const double area = left - right;
    return area > error ? 1 : area < -error ? -1 : 0;
}

/// An outline and the points it is made of.
struct Ring {
    std::span<const glm::dvec2> points;
    const Outline& corners;

    std::size_t size() const { return corners.size(); }
    const glm::dvec2& at(std::size_t i) const { return points[corners[i % size()]]; }
    const glm::dvec2& before(std::size_t i) const { return at(i + size() - 1); }
};

/// Whether `to` lies strictly inside the angle at corner i.
bool in_angle(const Ring& ring, std::size_t i, const glm::dvec2& to) {
    const glm::dvec2 &before = ring.before(i), &p = ring.at(i), &after = ring.at(i + 1);
    const bool left_of_out = side(p, after, to) > 0, left_of_in = side(before, p, to) > 0;
    const int turn = side(before, p, after);
    return turn < 0 ? left_of_out || left_of_in : left_of_out && left_of_in;
}

bool is_diagonal(const Ring& ring, std::size_t i, std::size_t j) {
    const glm::dvec2 &a = ring.at(i), &b = ring.at(j);
    if (!in_angle(ring, i, b) || !in_angle(ring, j, a)) return false;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const std::size_t next = (k + 1) % ring.size();
        if (k == i || k == j || next == i || next == j) continue;
        const glm::dvec2 &c = ring.at(k), &d = ring.at(next);
        const bool apart = side(a, b, c) * side(a, b, d) > 0 || side(c, d, a) * side(c, d, b) > 0;
        if (!apart) return false;
    }
    return true;
}

/// Inwards from corner i, halving its angle.
glm::dvec2 inwards(const Ring& ring, std::size_t i) {
    const glm::dvec2 in = ring.at(i) - ring.before(i), out = ring.at(i + 1) - ring.at(i);
    const glm::dvec2 along = glm::normalize(in) + glm::normalize(out);
    return {-along.y, along.x};
}

/// The edge that a ray from corner i meets first: its first corner, and how far along the ray.
std::optional<std::pair<std::size_t, double>> first_hit(const Ring& ring, std::size_t i,
                                                        const glm::dvec2& direction) {
    std::optional<std::pair<std::size_t, double>> nearest;
    for (std::size_t k = i + 1; k + 1 < i + ring.size(); ++k) {
        const glm::dvec2 a = ring.at(k) - ring.at(i), b = ring.at(k + 1) - ring.at(i);
        const double side_a = cross(direction, a), side_b = cross(direction, b);
        if ((side_a < 0.0) == (side_b < 0.0)) continue;
        const double t = cross(a, b) / (side_b - side_a);
        if (t > 0.0 && (!nearest || t < nearest->second)) nearest = {k % ring.size(), t};
    }
    return nearest;
}

/// A corner that corner i probably sees.
std::optional<std::size_t> seen_from(const Ring& ring, std::size_t i) {
    const glm::dvec2 direction = inwards(ring, i);
    const auto hit = first_hit(ring, i, direction);
    if (!hit) return std::nullopt;
    const glm::dvec2 place = direction * hit->second;
    const glm::dvec2 end = ring.at(hit->first) - ring.at(i); // right of the ray
    std::size_t best = hit->first;
    double best_slope = std::abs(cross(direction, end)) / glm::dot(direction, end);
    if (!(best_slope >= 0.0)) best_slope = std::numeric_limits<double>::infinity();
    for (std::size_t k = i + 1; k < i + ring.size(); ++k) {
        const glm::dvec2 p = ring.at(k) - ring.at(i);
        const double off = -cross(direction, p), along = glm::dot(direction, p);
        if (off < 0.0 || along <= 0.0 || off >= best_slope * along) continue;
        if (cross(end - place, p - place) * cross(end - place, -place) < 0.0) continue; // beyond
        best = k % ring.size();
        best_slope = off / along;
    }
    return best;
}

struct Diagonal {
    std::size_t from, to;
};

/// The one that divides most evenly of some, or none.
std::optional<Diagonal> find_diagonal(const Ring& ring) {
    std::optional<Diagonal> best;
    std::size_t best_part = 0;
    for (std::size_t k = 0; k < tries; ++k) {
        // Fractions of the golden ratio lie evenly, whatever their number.
        const auto i = static_cast<std::size_t>(std::fmod(double(k) * 0.6180339887498949, 1.0) *
                                                double(ring.size()));
        const auto j = seen_from(ring, i);
        if (!j) continue;
        const std::size_t apart = *j > i ? *j - i : i - *j;
        const std::size_t part = std::min(apart, ring.size() - apart);
        if (part < 2 || part <= best_part || !is_diagonal(ring, i, *j)) continue;
        best = Diagonal{std::min(i, *j), std::max(i, *j)};
        best_part = part;
    }
    return best;
}

} // namespace

std::vector<Outline> cut_at_diagonals(std::span<const glm::dvec2> points, std::size_t largest) {
    std::vector<Outline> open(1), done;
    for (std::uint32_t i = 0; i < points.size(); ++i)
        open[0].push_back(i);
    while (!open.empty()) {
        const Outline outline = std::move(open.back());
        open.pop_back();
        const auto cut = outline.size() > largest ? find_diagonal({points, outline}) : std::nullopt;
        if (!cut) {
            done.push_back(outline);
            continue;
        }
        const auto at = [&](std::size_t i) {
            return outline.begin() + static_cast<std::ptrdiff_t>(i);
        };
        open.emplace_back(at(cut->from), at(cut->to + 1));
        open.emplace_back(at(cut->to), outline.end());
        open.back().insert(open.back().end(), outline.begin(), at(cut->from + 1));
    }
    return done;
}

} // namespace parhelion
