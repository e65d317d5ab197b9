// Polygons in the plane to triangles, by the tessellator of GLU.
#include "host/scene/meshes/polygon_pieces.h"

#include <GL/glu.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <limits>
#include <memory>
#include <new>

namespace parhelion {

namespace {

constexpr std::size_t quick = 1024; ///< corners that the tessellator takes in some milliseconds

/// Corners that it takes in some seconds. Outlines that do not cross themselves have diagonals.
constexpr std::size_t largest_uncut = 16 * quick;

/// Crossings that an outline may have: there can be half the square of its corners.
std::size_t most_crossings(std::size_t corners) { return 4 * corners + 1024; }

/// The tessellator's work on one outline. Its callbacks are called from C: nothing may be thrown,
/// and the one way to stop is to jump.
class Tessellation {
public:
    explicit Tessellation(std::span<const glm::dvec2> outline)
        : points_(outline.begin(), outline.end()), most_(most_crossings(outline.size())) {}

    /// Adds the triangles and crossings of the part of the outline to `result`.
    void run(const Outline& part, PolygonTriangles& result);

private:
    void feed(GLUtesselator* tess, const Outline& part);
    void add_corner(std::uint32_t corner);
    std::uint32_t corner_at(std::span<void* const, 4> ends);

    std::vector<glm::dvec2> points_; ///< corners, then crossings
    std::size_t most_;               ///< crossings
    PolygonTriangles* result_ = nullptr;
    std::jmp_buf stop_;
    std::array<std::uint32_t, 3> triangle_{};
    int filled_ = 0;
    bool no_memory_ = false;

    static Tessellation& self(void* data) { return *static_cast<Tessellation*>(data); }
    // A null pointer says "no corner", so numbers go through the library from 1.
    static std::uint32_t number(void* corner) {
        return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(corner) - 1);
    }
    static void* handle(std::uint32_t corner) {
        return reinterpret_cast<void*>(static_cast<std::uintptr_t>(corner) + 1);
    }
    static void on_vertex(void* corner, void* data) { self(data).add_corner(number(corner)); }
    static void on_edge(GLboolean, void*) {} ///< having it asks for triangles alone
    static void on_crossing(GLdouble*, void** ends, GLfloat*, void** corner, void* data);
    static void on_error(GLenum, void* data) { self(data).no_memory_ = true; }
};

void Tessellation::add_corner(std::uint32_t corner) try {
    triangle_[static_cast<std::size_t>(filled_)] = corner;
    filled_ = (filled_ + 1) % 3;
    if (filled_ == 0) result_->triangles.emplace_back(triangle_[0], triangle_[1], triangle_[2]);
} catch (const std::bad_alloc&) {
    no_memory_ = true;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// How far along the edge from a to b it meets the line from c to d; the middle where they are
/// parallel, so that any place will do.
double meeting(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
    const double t = cross(c - a, d - c) / cross(b - a, d - c);
    return t >= 0.0 && t <= 1.0 ? t : 0.5;
}

/// Corners that coincide are called here as well, without a second edge: the first of them stands
/// for all. A crossing is the mean of its places on both edges; the tessellator's own weights, and
/// the place it says, have single precision.
std::uint32_t Tessellation::corner_at(std::span<void* const, 4> ends) {
    if (!ends[2] && !ends[3]) return number(ends[0]);
    CrossingCorner crossing{};
    std::transform(ends.begin(), ends.end(), crossing.corners.begin(), number);
    std::array<glm::dvec2, 4> p;
    std::transform(crossing.corners.begin(), crossing.corners.end(), p.begin(),
                   [&](std::uint32_t corner) { return points_[corner]; });
    const double t = meeting(p[0], p[1], p[2], p[3]), s = meeting(p[2], p[3], p[0], p[1]);
    crossing.weights = {0.5 * (1.0 - t), 0.5 * t, 0.5 * (1.0 - s), 0.5 * s};
    glm::dvec2 place(0.0);
    for (std::size_t k = 0; k < 4; ++k)
        place += crossing.weights[k] * p[k];
    result_->crossings.push_back(crossing);
    points_.push_back(place);
    return static_cast<std::uint32_t>(points_.size() - 1);
}

void Tessellation::on_crossing(GLdouble*, void** ends, GLfloat*, void** corner, void* data) try {
    if (self(data).result_->crossings.size() >= self(data).most_) std::longjmp(self(data).stop_, 1);
    *corner = handle(self(data).corner_at(std::span<void* const, 4>(ends, 4)));
} catch (const std::bad_alloc&) {
    self(data).no_memory_ = true;
    *corner = ends[0];
}

void Tessellation::feed(GLUtesselator* tess, const Outline& part) {
    using Callback = void (*)();
    const auto call = [&](GLenum event, auto* function) {
        gluTessCallback(tess, event, reinterpret_cast<Callback>(function));
    };
    call(GLU_TESS_VERTEX_DATA, on_vertex);
    call(GLU_TESS_EDGE_FLAG_DATA, on_edge);
    call(GLU_TESS_COMBINE_DATA, on_crossing);
    call(GLU_TESS_ERROR_DATA, on_error);
    gluTessNormal(tess, 0.0, 0.0, 1.0);
    gluTessBeginPolygon(tess, this);
    gluTessBeginContour(tess);
    for (const std::uint32_t corner : part) {
        std::array<GLdouble, 3> place = {points_[corner].x, points_[corner].y, 0.0};
        gluTessVertex(tess, place.data(), handle(corner));
    }
    gluTessEndContour(tess);
    gluTessEndPolygon(tess);
}

void Tessellation::run(const Outline& part, PolygonTriangles& result) {
    result_ = &result;
    const std::unique_ptr<GLUtesselator, void (*)(GLUtesselator*)> tess(gluNewTess(),
                                                                        gluDeleteTess);
    if (!tess) throw std::bad_alloc();
    if (setjmp(stop_) == 0)
        feed(tess.get(), part);
    else
        result.tangled = true;
    if (no_memory_) throw std::bad_alloc();
}

PolygonTriangles cover(std::span<const glm::dvec2> outline, const std::vector<Outline>& parts) {
    PolygonTriangles result;
    Tessellation tessellation(outline);
    for (const Outline& part : parts) {
        if (part.size() > largest_uncut)
            result.tangled = true;
        else
            tessellation.run(part, result);
        if (result.tangled) return {.triangles = {}, .crossings = {}, .tangled = true};
    }
    return result;
}

double twice_area(std::span<const glm::dvec2> p, const glm::uvec3& t) {
    return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
}

/// Nothing crosses, and the triangles have the area that the outline goes around.
bool is_whole(const PolygonTriangles& cover, std::span<const glm::dvec2> outline) {
    if (!cover.crossings.empty()) return false;
    double covered = 0.0, outlined = 0.0, terms = 0.0;
    for (const glm::uvec3& t : cover.triangles)
        covered += twice_area(outline, t);
    for (std::uint32_t i = 2; i < outline.size(); ++i) {
        outlined += twice_area(outline, {0, i - 1, i});
        terms += std::abs(twice_area(outline, {0, i - 1, i}));
    }
    const double rounding = std::numeric_limits<double>::epsilon();
    return std::abs(covered - outlined) <= rounding * static_cast<double>(outline.size()) * terms;
}

} // namespace

PolygonTriangles cover_with_triangles(std::span<const glm::dvec2> outline) {
    const std::vector<Outline> parts = cut_at_diagonals(outline, quick);
    PolygonTriangles result = cover(outline, parts);
    // Parts of an outline that crosses itself may lie over each other.
    if (parts.size() == 1 || (!result.tangled && is_whole(result, outline))) return result;
    return cover(outline, cut_at_diagonals(outline, outline.size()));
}

} // namespace parhelion
