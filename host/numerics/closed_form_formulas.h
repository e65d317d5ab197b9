// The closed formulas behind scenes/closed_form, in double: form factors, Fresnel averages,
// coverage.
#pragma once

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace parhelion::closed_form {

inline constexpr double pi = std::numbers::pi;

/// sum of r^k for k = 0 .. terms-1.
inline double geometric_sum(double r, int terms) { return (1 - std::pow(r, terms)) / (1 - r); }

/// The square of the plane that pixel (x, y) of an n x n image sees, where the image shows
/// [-half_width, half_width]^2 of a plane perpendicular to the axis, x to the right and y up.
struct Footprint {
    double x0, x1, y0, y1;
    double area() const { return (x1 - x0) * (y1 - y0); }
};

inline Footprint pixel_footprint(int x, int y, int n, double half_width) {
    const double step = 2 * half_width / n;
    return {x * step - half_width, (x + 1) * step - half_width, half_width - (y + 1) * step,
            half_width - y * step};
}

/// Mean over the footprint of h/(h^2 + x^2 + y^2)^(3/2): the solid angle of the rectangle seen
/// from height h over the origin, by its antiderivative atan(x y/(h sqrt(x^2 + y^2 + h^2))).
inline double mean_inverse_square_cosine(const Footprint& f, double h) {
    const auto solid = [h](double x, double y) {
        return std::atan2(x * y, h * std::sqrt(x * x + y * y + h * h));
    };
    return (solid(f.x1, f.y1) - solid(f.x0, f.y1) - solid(f.x1, f.y0) + solid(f.x0, f.y0)) /
           f.area();
}

/// Form factor from a point to a parallel a x b rectangle at height h with a corner above the
/// point.
inline double corner_form_factor(double a, double b, double h) {
    const double u = std::hypot(a, h), v = std::hypot(b, h);
    return (a / u * std::atan(b / u) + b / v * std::atan(a / v)) / (2 * pi);
}

/// Irradiance over (pi times radiance) at the origin, normal +z, from a polygon above the horizon:
/// Lambert's sum over the edges of (angle) x (unit normal of the edge's plane) . z / (2 pi).
inline double polygon_form_factor(const std::vector<glm::dvec3>& corners) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = corners[i], b = corners[(i + 1) % corners.size()];
        const glm::dvec3 gamma = glm::cross(a, b);
        const double angle = std::atan2(glm::length(gamma), glm::dot(a, b));
        sum += angle * gamma.z / glm::length(gamma);
    }
    return std::abs(sum) / (2 * pi);
}

/// Alternating sum of an antiderivative over the corners of two rectangles: the form factor of
/// rectangle 1 (x, y) to rectangle 2 (u, v) times 2 pi times the area of rectangle 1.
template<class Antiderivative>
double rectangle_pair_sum(const std::array<double, 2>& x, const std::array<double, 2>& y,
                          const std::array<double, 2>& u, const std::array<double, 2>& v,
                          Antiderivative g) {
    double sum = 0;
    for (int i = 0; i < 16; ++i) {
        const int a = i & 1, b = i >> 1 & 1, c = i >> 2 & 1, d = i >> 3 & 1;
        sum += ((a + b + c + d) % 2 ? -1.0 : 1.0) * g(x[a], y[b], u[c], v[d]);
    }
    return sum;
}

/// Form factor from a footprint in z = 0 to the rectangle `other` in z = h, axes parallel
/// (the double area integral of h^2/(pi r^4), done in closed form).
inline double parallel_form_factor(const Footprint& f, const Footprint& other, double h) {
    const auto g = [h](double x, double y, double u, double v) {
        const double dx = x - u, dy = y - v, p = std::hypot(dx, h), q = std::hypot(dy, h);
        return dy * p * std::atan(dy / p) + dx * q * std::atan(dx / q) -
               h * h / 2 * std::log(dx * dx + dy * dy + h * h);
    };
    return rectangle_pair_sum({f.x0, f.x1}, {f.y0, f.y1}, {other.x0, other.x1},
                              {other.y0, other.y1}, g) /
           (2 * pi * f.area());
}

/// Form factor from a footprint in z = 0 to the rectangle y in [v0, v1], z in [0, height] of the
/// perpendicular plane x = wall_x >= f.x1.
inline double perpendicular_form_factor(const Footprint& f, double wall_x, double v0, double v1,
                                        double height) {
    const auto g = [](double s, double y, double z, double v) {
        const double dy = y - v, c2 = s * s + z * z, c = std::sqrt(c2), d2 = c2 + dy * dy;
        const double angle = c > 0 ? dy * c * std::atan(dy / c) : 0;
        return angle - (d2 > 0 ? (c2 - dy * dy) / 4 * std::log(d2) : 0);
    };
    const double sum = rectangle_pair_sum({wall_x - f.x1, wall_x - f.x0}, {f.y0, f.y1},
                                          {0.0, height}, {v0, v1}, g);
    return std::abs(sum) / (2 * pi * f.area());
}

/// Unpolarised Fresnel reflectance of a conductor in air, cosine c of incidence, complex index.
inline double conductor_reflectance(double c, double eta, double k) {
    const std::complex<double> n2 = std::complex<double>(eta, k) * std::complex<double>(eta, k);
    const std::complex<double> g = std::sqrt(n2 - (1 - c * c));
    return (std::norm((c - g) / (c + g)) + std::norm((n2 * c - g) / (n2 * c + g))) / 2;
}

/// Hemispherical (cosine-weighted) Fresnel reflectance of a dielectric, from outside (Walsh).
inline double hemispherical_fresnel_outside(double n) {
    const double n2 = n * n, n4 = n2 * n2, up = n2 + 1, q = n4 - 1;
    return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
           n2 * (n2 - 1) * (n2 - 1) / (up * up * up) * std::log((n - 1) / (n + 1)) -
           2 * n * n2 * (n2 + 2 * n - 1) / (up * q) +
           8 * n4 * (n4 + 1) / (up * q * q) * std::log(n);
}

/// The same from inside: as much diffuse light leaves as enters, n^2 (1 - inside) = 1 - outside.
inline double hemispherical_fresnel_inside(double n) {
    return 1 - (1 - hemispherical_fresnel_outside(n)) / (n * n);
}

/// Part of the footprint where dot(p - point, normal) < 0: the square is cut by the line
/// (Sutherland-Hodgman) and the area of what is left taken by the shoelace sum.
inline double half_plane_coverage(const Footprint& f, glm::dvec2 point, glm::dvec2 normal) {
    const std::array<glm::dvec2, 4> square{
        {{f.x0, f.y0}, {f.x1, f.y0}, {f.x1, f.y1}, {f.x0, f.y1}}};
    std::vector<glm::dvec2> kept;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 a = square[i], b = square[(i + 1) % 4];
        const double da = glm::dot(a - point, normal), db = glm::dot(b - point, normal);
        if (da < 0) kept.push_back(a);
        if ((da < 0) != (db < 0)) kept.push_back(a + (b - a) * (da / (da - db)));
    }
    double twice_area = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const glm::dvec2 a = kept[i], b = kept[(i + 1) % kept.size()];
        twice_area += a.x * b.y - b.x * a.y;
    }
    return twice_area / 2 / f.area();
}

/// Part of the unit disk beyond the line at distance t from its centre.
inline double disk_beyond_line(double t) { return (std::acos(t) - t * std::sqrt(1 - t * t)) / pi; }

} // namespace parhelion::closed_form
