// Triangles seen from the origin: made at random, measured, and their solid angle in quadruple
// precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "host/numerics/measure.h"

namespace parhelion::numerics {

using Corners = std::array<f32::vec3, 3>;

inline f64::vec3 area_vector(const Corners& c) {
    return f64::cross3(f64::sub3(wide(c[1]), wide(c[0])), f64::sub3(wide(c[2]), wide(c[0])));
}

/// Distance of the triangle's plane.
inline double height_over_plane(const Corners& c) {
    return std::fabs(f64::dot3(wide(c[0]), f64::normalize3(area_vector(c))));
}

inline double farthest_corner(const Corners& c) {
    return std::max({f64::length3(wide(c[0])), f64::length3(wide(c[1])), f64::length3(wide(c[2]))});
}

/// The sine of the angle under which its farthest corner sees it.
inline double facing(const Corners& c) { return height_over_plane(c) / farthest_corner(c); }

/// The sine of its largest angle: small for needles.
inline double bluntness(const Corners& c) {
    std::array<double, 3> sides{};
    for (std::size_t k = 0; k < 3; k++)
        sides[k] = f64::length3(f64::sub3(wide(c[(k + 1) % 3]), wide(c[k])));
    std::ranges::sort(sides);
    return f64::length3(area_vector(c)) / (sides[0] * sides[1]);
}

/// Some `size` wide at distance 1 (1: as large as it is far), not seen from its own plane: there
/// its solid angle and its points hang on the last bits of the corners.
inline Corners triangle_ahead(Random& random, double size) {
    f64::vec3 at = random.direction<F64>();
    Corners c;
    do
        for (f32::vec3& corner : c)
            corner = vec_as<F32>(f64::add3(at, f64::scale3(random.direction<F64>(), size)));
    while (!(height_over_plane(c) > 0.1));
    return c;
}

/// Whose one side, any of the three, passes the origin at the distance `apart`, its own length
/// being 1: where a wall that shines meets a floor.
inline Corners triangle_beside(Random& random, double apart) {
    Corners c;
    do {
        f64::vec3 along = random.direction<F64>(),
                  off = f64::scale3(random.direction<F64>(), apart);
        c = {vec_as<F32>(f64::add3(off, f64::scale3(along, random.between(0.1, 1)))),
             vec_as<F32>(f64::add3(off, f64::scale3(along, -random.between(0.1, 1)))),
             vec_as<F32>(random.direction<F64>())};
    } while (!(facing(c) > 0.03 * apart));
    std::rotate(c.begin(), c.begin() + static_cast<std::ptrdiff_t>(random.bits() % 3), c.end());
    return c;
}

/// Van Oosterom and Strackee's formula as it stands, sr.
inline long double solid_angle_truth(const Corners& c) {
    using Exact = __float128;
    Exact v[3][3];
    for (std::size_t i = 0; i < 3; i++)
        v[i][0] = c[i].x, v[i][1] = c[i].y, v[i][2] = c[i].z;
    auto product = [&](int i, int j) {
        return v[i][0] * v[j][0] + v[i][1] * v[j][1] + v[i][2] * v[j][2];
    };
    auto square_root = [](Exact x) {
        Exact guess = sqrtl(static_cast<long double>(x));
        return guess > 0 ? (guess + x / guess) / 2 : guess;
    };
    Exact volume = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) +
                   v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
                   v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    Exact l0 = square_root(product(0, 0)), l1 = square_root(product(1, 1)),
          l2 = square_root(product(2, 2));
    Exact rest = l0 * l1 * l2 + product(0, 1) * l2 + product(0, 2) * l1 + product(1, 2) * l0;
    return 2 * atan2l(fabsl(static_cast<long double>(volume)), static_cast<long double>(rest));
}

} // namespace parhelion::numerics
