// Collections of primitives that are hard on a tree or on a ray, and rays aimed at them.
#pragma once

#include "host/numerics/host_walk.h"

#include <cmath>
#include <random>
#include <vector>

namespace parhelion::rays {

using Primitives = std::vector<PrimitiveRecord>;
using Random = std::mt19937;

/// In [low, high), the same on every platform.
inline float uniform(Random& random, float low, float high) {
    return low + (high - low) * (float(random() >> 8) * 0x1p-24f);
}

inline Vector uniform_vector(Random& random, float low, float high) {
    float x = uniform(random, low, high), y = uniform(random, low, high),
          z = uniform(random, low, high);
    return {x, y, z};
}

inline Vector add(const Vector& a, const Vector& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector subtract(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector scaled(const Vector& a, float s) { return {a[0] * s, a[1] * s, a[2] * s}; }

inline PrimitiveRecord primitive(int kind, const Vector& a, const Vector& b, const Vector& c,
                                 float radius = 0.f) {
    PrimitiveRecord p{};
    p.ax = a[0], p.ay = a[1], p.az = a[2];
    p.bx = b[0], p.by = b[1], p.bz = b[2];
    p.cx = c[0], p.cy = c[1], p.cz = c[2];
    p.extra = radius;
    p.flags = kind | PRIMITIVE_UVS; // a flag that is not the kind
    return p;
}

inline PrimitiveRecord triangle(const Vector& a, const Vector& b, const Vector& c) {
    return primitive(geometry_triangle, a, b, c);
}

inline PrimitiveRecord sphere(const Vector& centre, float radius) {
    return primitive(geometry_sphere, centre, {radius, 0, 0}, {0, 0, radius}, radius);
}

inline PrimitiveRecord disk(const Vector& centre, const Vector& edge_u, const Vector& edge_v) {
    return primitive(geometry_disk, centre, edge_u, edge_v);
}

inline PrimitiveRecord cylinder(const Vector& base, const Vector& axis, float radius) {
    // Some side across the axis, of that length.
    Vector along = std::fabs(axis[0]) < std::fabs(axis[1]) ? Vector{1, 0, 0} : Vector{0, 1, 0};
    Vector side{axis[1] * along[2] - axis[2] * along[1], axis[2] * along[0] - axis[0] * along[2],
                axis[0] * along[1] - axis[1] * along[0]};
    float length = std::sqrt(side[0] * side[0] + side[1] * side[1] + side[2] * side[2]);
    return primitive(geometry_cylinder, base, axis, scaled(side, radius / length), radius);
}

inline Primitives random_triangles(int count, float size) {
    Random random(1);
    Primitives result;
    for (int i = 0; i < count; i++) {
        Vector a = uniform_vector(random, -1, 1);
        Vector b = add(a, uniform_vector(random, -size, size)),
               c = add(a, uniform_vector(random, -size, size));
        result.push_back(triangle(a, b, c));
    }
    return result;
}

/// Triangles, spheres, disks and cylinders in turn.
inline Primitives random_mixture(int count) {
    Random random(2);
    Primitives result;
    for (int i = 0; i < count; i++) {
        Vector a = uniform_vector(random, -1, 1);
        Vector u = uniform_vector(random, -.1f, .1f), v = uniform_vector(random, -.1f, .1f);
        if (i % 4 == 0) result.push_back(triangle(a, add(a, u), add(a, v)));
        if (i % 4 == 1) result.push_back(sphere(a, uniform(random, 0.001f, .1f)));
        if (i % 4 == 2) result.push_back(disk(a, u, v));
        if (i % 4 == 3) result.push_back(cylinder(a, u, uniform(random, 0.001f, .1f)));
    }
    return result;
}

/// A closed mesh: an octahedron, each triangle divided into four `levels` times, its corners put on
/// a sphere.
inline Primitives subdivided_sphere(int levels, float radius, const Vector& centre) {
    using Corners = std::array<Vector, 3>;
    Vector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, nx{-1, 0, 0}, ny{0, -1, 0}, nz{0, 0, -1};
    std::vector<Corners> faces{{x, y, z},  {y, nx, z},  {nx, ny, z},  {ny, x, z},
                               {y, x, nz}, {nx, y, nz}, {ny, nx, nz}, {x, ny, nz}};
    // Symmetric in both ends, so that neighbours compute the same corner.
    auto middle = [](const Vector& a, const Vector& b) {
        Vector m = add(a, b);
        return scaled(m, 1.f / std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]));
    };
    for (int level = 0; level < levels; level++) {
        std::vector<Corners> finer;
        for (const auto& [a, b, c] : faces) {
            Vector ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        faces = finer;
    }
    auto place = [&](const Vector& v) { return add(scaled(v, radius), centre); };
    Primitives result;
    for (const auto& [a, b, c] : faces)
        result.push_back(triangle(place(a), place(b), place(c)));
    return result;
}

/// The surface of a cube of n x n x n cells, edge length 2 radius; many rays to its corners are
/// parallel to an axis.
inline Primitives cube_surface(int n, float radius, const Vector& centre) {
    Primitives result;
    auto corner = [&](int axis, float side, int i, int j) {
        Vector v;
        v[std::size_t(axis)] = side;
        v[std::size_t(axis + 1) % 3] = float(2 * i) / float(n) - 1;
        v[std::size_t(axis + 2) % 3] = float(2 * j) / float(n) - 1;
        return add(scaled(v, radius), centre);
    };
    for (int axis = 0; axis < 3; axis++)
        for (float side : {-1.f, 1.f})
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++) {
                    Vector a = corner(axis, side, i, j), b = corner(axis, side, i + 1, j);
                    Vector c = corner(axis, side, i + 1, j + 1), d = corner(axis, side, i, j + 1);
                    result.push_back(triangle(a, b, c));
                    result.push_back(triangle(a, c, d));
                }
    return result;
}

/// A flat square of n x n cells, two triangles each, at height z.
inline Primitives grid(int n, float z) {
    Primitives result;
    auto corner = [&](int i, int j) {
        return Vector{float(2 * i) / float(n) - 1, float(2 * j) / float(n) - 1, z};
    };
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            result.push_back(triangle(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)));
            result.push_back(triangle(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)));
        }
    return result;
}

/// Long and thin, in all directions.
inline Primitives needles(int count) {
    Random random(3);
    Primitives result;
    for (int i = 0; i < count; i++) {
        Vector a = uniform_vector(random, -1, 1), b = uniform_vector(random, -1, 1);
        result.push_back(triangle(a, b, add(a, uniform_vector(random, -1e-3f, 1e-3f))));
    }
    return result;
}

inline Primitives repeated(const Primitives& primitives, int times) {
    Primitives result;
    for (int i = 0; i < times; i++)
        result.insert(result.end(), primitives.begin(), primitives.end());
    return result;
}

/// Triangles of size ratio^-k that share a corner: each holds all that follow, as far as floats
/// reach.
inline Primitives geometric_series(float ratio, int count) {
    Primitives result;
    float size = 1;
    for (int k = 0; k < count && size > 0; k++, size /= ratio)
        result.push_back(
            triangle({0, 0, 0}, {size, size / 2, size / 3}, {size / 3, size, size / 2}));
    return result;
}

/// Ray i of a set: from outside or inside the cube [-1, 1]^3; a third are parallel to an axis or to
/// a coordinate plane.
inline Ray random_ray(Random& random, int i) {
    Ray ray{uniform_vector(random, -1.5f, 1.5f), uniform_vector(random, -1, 1)};
    auto axis = std::size_t(i / 3 % 3);
    if (i % 6 == 0) ray.direction[axis] = 0;
    if (i % 6 == 3)
        ray.direction[(axis + 1) % 3] = ray.direction[(axis + 2) % 3] = i % 4 == 0 ? 0.f : -0.f;
    return ray;
}

} // namespace parhelion::rays
