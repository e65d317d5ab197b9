// Closed convex meshes of long, thin and huge triangles, and points inside of them.
#pragma once

#include "host/numerics/shapes.h"

#include <cmath>
#include <string>
#include <vector>

namespace parhelion::rays {

using Wide = std::array<double, 3>;

/// Axes and a centre. Corners are rounded once, here.
struct Placing {
    std::array<Wide, 3> axis{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Wide centre{};

    Vector at(double x, double y, double z) const {
        Vector v;
        for (std::size_t k = 0; k < 3; k++)
            v[k] = float(centre[k] + x * axis[0][k] + y * axis[1][k] + z * axis[2][k]);
        return v;
    }

    /// Of what is `half` long: lengths along an axis do not round those across it.
    double rounding(double half) const {
        bool along_axes = axis[0][0] == 1 && axis[1][1] == 1 && centre == Wide{};
        double size = along_axes ? 1 : half;
        for (double c : centre)
            size += std::fabs(c);
        return size * 0x1p-24;
    }
};

/// Turned about all axes by random angles.
inline Placing turned(Random& random, const Wide& centre) {
    Placing p;
    p.centre = centre;
    for (std::size_t k = 0; k < 3; k++) {
        double angle = uniform(random, 0, 6.28f), c = std::cos(angle), s = std::sin(angle);
        for (Wide& v : p.axis) {
            double x = v[(k + 1) % 3], y = v[(k + 2) % 3];
            v[(k + 1) % 3] = c * x - s * y, v[(k + 2) % 3] = s * x + c * y;
        }
    }
    return p;
}

/// Convex but for the rounding of its corners, with a ball of radius 0.7 about the centre in it.
struct LongMesh {
    std::string name;
    Primitives mesh;
    Wide centre;
    double rounding; ///< of corners and of points inside, across the mesh

    /// From right at the surface, by 16 of that rounding, to the centre.
    Vector inside(Random& random) const {
        const PrimitiveRecord& p = mesh[random() % mesh.size()];
        double u = uniform(random, 0, 1), v = uniform(random, 0, 1);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        double scale = std::exp(std::log(16 * rounding) * uniform(random, 0, 1));
        const float a[] = {p.ax, p.ay, p.az}, b[] = {p.bx, p.by, p.bz}, c[] = {p.cx, p.cy, p.cz};
        Vector at;
        for (std::size_t k = 0; k < 3; k++) {
            double on = a[k] + u * (double{b[k]} - a[k]) + v * (double{c[k]} - a[k]);
            at[k] = float(centre[k] + (1 - scale) * (on - centre[k]));
        }
        return at;
    }
};

/// A surface of `pieces` rings of n quads each about the z axis, closed by a fan at each end;
/// ring(k, phi) is a point of it. A ring of no radius closes it alone.
template<class Ring>
Primitives rings(int n, int pieces, const Ring& ring) {
    auto at = [&](int k, int i) { return ring(k, 2 * M_PI * (i % n) / n); };
    Primitives mesh;
    for (int k = 0; k < pieces; k++)
        for (int i = 0; i < n; i++) {
            Vector a = at(k, i), b = at(k, i + 1), c = at(k + 1, i + 1), d = at(k + 1, i);
            if (a != b) mesh.push_back(triangle(a, b, c));
            if (c != d) mesh.push_back(triangle(a, c, d));
        }
    for (int k : {0, pieces})
        for (int i = 1; i + 1 < n && at(k, 0) != at(k, 1); i++)
            mesh.push_back(triangle(at(k, 0), at(k, i), at(k, i + 1)));
    return mesh;
}

/// Of circumradius 1, half as long as said; n sides of `pieces` rows of quads: a box, a tunnel of
/// strips, a cylinder.
inline LongMesh prism(const std::string& name, int n, int pieces, double half, const Placing& p) {
    auto ring = [&](int k, double phi) {
        return p.at(std::cos(phi), std::sin(phi), half * (2. * k / pieces - 1));
    };
    return {name, rings(n, pieces, ring), p.centre, p.rounding(half)};
}

/// Two fans of n needles from the ends of the axis to a ring in the middle.
inline LongMesh needle_fans(int n, double half, const Placing& p) {
    auto ring = [&](int k, double phi) {
        return k == 1 ? p.at(std::cos(phi), std::sin(phi), 0) : p.at(0, 0, half * (k - 1));
    };
    return {"needle fans", rings(n, 2, ring), p.centre, p.rounding(half)};
}

/// Huge sheets, close together: a square prism, long across its axis.
inline LongMesh slab(double half, const Placing& p) {
    auto ring = [&](int k, double phi) {
        return p.at(half * std::cos(phi), half * std::sin(phi), 2 * k - 1);
    };
    return {"slab", rings(4, 1, ring), p.centre, p.rounding(half)};
}

inline std::vector<LongMesh> long_meshes(double half, const Placing& p) {
    return {prism("box", 4, 1, half, p),
            prism("prism", 7, 1, half, p),
            prism("strips", 200, 1, half, p),
            prism("cylinder", 32, 12, half, p),
            prism("mixed strips", 24, 2, half, p),
            needle_fans(32, half, p),
            slab(half, p)};
}

} // namespace parhelion::rays
