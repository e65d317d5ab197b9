// Smooth surfaces as meshes of any fineness, with the normals of what they stand for.
#pragma once

#include "host/scene/scene.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace parhelion::test {

/// A point of a surface and its unit normal.
struct SurfacePoint {
    glm::dvec3 p, n;
};

inline glm::dvec3 on_sphere(double turn, double fall) {
    return {std::sin(fall) * std::cos(turn), std::cos(fall), std::sin(fall) * std::sin(turn)};
}

// turn: 0 to 2 pi about the y axis; fall: 0 to pi from the top down, or around the tube.

inline SurfacePoint sphere_point(double turn, double fall) {
    glm::dvec3 p = on_sphere(turn, fall);
    return {p, p};
}

inline SurfacePoint ellipsoid_point(double turn, double fall) {
    const glm::dvec3 axes(1, 0.5, 0.7);
    glm::dvec3 p = on_sphere(turn, fall);
    return {p * axes, glm::normalize(p / axes)};
}

inline SurfacePoint torus_point(double turn, double fall) {
    glm::dvec3 out(std::cos(turn), 0, std::sin(turn));
    glm::dvec3 n = std::cos(2 * fall) * out + glm::dvec3(0, std::sin(2 * fall), 0);
    return {0.7 * out + 0.3 * n, n};
}

/// Faces: `rows` along fall, twice as many along turn, cut in two; those of no area are left out.
inline Mesh smooth_mesh(SurfacePoint (*at)(double, double), unsigned rows) {
    unsigned columns = 2 * rows;
    Mesh m;
    for (unsigned i = 0; i <= rows; i++)
        for (unsigned j = 0; j <= columns; j++) {
            SurfacePoint s = at(2 * std::numbers::pi * j / columns, std::numbers::pi * i / rows);
            m.positions.push_back(s.p), m.normals.push_back(s.n);
        }
    auto add = [&](glm::uvec3 t) {
        glm::dvec3 a = m.positions[t.x], n = glm::cross(m.positions[t.y] - a, m.positions[t.z] - a);
        if (glm::length(n) < 1e-12) return;
        bool inward = glm::dot(n, m.normals[t.x] + m.normals[t.y] + m.normals[t.z]) < 0;
        m.triangles.push_back(inward ? glm::uvec3(t.x, t.z, t.y) : t);
    };
    for (unsigned i = 0; i < rows; i++)
        for (unsigned j = 0; j < columns; j++) {
            unsigned a = i * (columns + 1) + j, d = a + columns + 1;
            add({a, a + 1, d + 1}), add({a, d + 1, d});
        }
    return m;
}

} // namespace parhelion::test
