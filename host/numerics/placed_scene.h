// A scene in another place, turned and of another size.
#pragma once

#include "host/numerics/every_kind_scene.h"

#include <glm/mat3x3.hpp>

#include <cmath>

namespace parhelion::numerics {

/// x -> scale * turn * x + move.
struct Placement {
    double scale = 1.0;
    glm::dvec3 move{0.0};
    glm::dmat3 turn{1.0};

    glm::dvec3 point(const glm::dvec3& p) const { return scale * (turn * p) + move; }
};

inline Mesh placed(Mesh m, const Placement& t) {
    for (glm::dvec3& p : m.positions)
        p = t.point(p);
    for (glm::dvec3& n : m.normals)
        n = t.turn * n;
    return m;
}

inline Sphere placed(Sphere s, const Placement& t) {
    s.center = t.point(s.center), s.radius *= t.scale;
    s.axis_x = t.turn * s.axis_x, s.axis_y = t.turn * s.axis_y, s.axis_z = t.turn * s.axis_z;
    return s;
}

inline Disk placed(Disk d, const Placement& t) {
    d.center = t.point(d.center);
    d.edge_u = t.scale * (t.turn * d.edge_u), d.edge_v = t.scale * (t.turn * d.edge_v);
    return d;
}

inline Cylinder placed(Cylinder c, const Placement& t) {
    c.base = t.point(c.base);
    c.axis = t.scale * (t.turn * c.axis), c.side = t.scale * (t.turn * c.side);
    return c;
}

inline Emitter placed(PointEmitter e, const Placement& t) {
    e.position = t.point(e.position), e.intensity *= t.scale * t.scale;
    return e;
}

inline void place(Slide& slide, const Placement& t) {
    slide.across = t.turn * slide.across, slide.down = t.turn * slide.down;
}

inline Emitter placed(SpotEmitter e, const Placement& t) {
    e.position = t.point(e.position), e.intensity *= t.scale * t.scale;
    e.direction = t.turn * e.direction;
    place(e.slide, t);
    return e;
}

inline Emitter placed(ProjectorEmitter e, const Placement& t) {
    e.position = t.point(e.position), e.irradiance *= t.scale * t.scale;
    e.direction = t.turn * e.direction;
    place(e.slide, t);
    return e;
}

inline Emitter placed(DirectionalEmitter e, const Placement& t) {
    e.direction = t.turn * e.direction;
    return e;
}

inline Emitter placed(const ConstantEmitter& e, const Placement&) { return e; }

inline Emitter placed(EnvmapEmitter e, const Placement& t) {
    for (int axis = 0; axis < 3; axis++)
        e.to_world[axis] = t.turn * e.to_world[axis];
    return e;
}

inline Emitter placed(SunskyEmitter e, const Placement& t) {
    for (int axis = 0; axis < 3; axis++)
        e.to_world[axis] = t.turn * e.to_world[axis];
    return e;
}

inline Camera placed(Camera c, const Placement& t) {
    for (int axis = 0; axis < 3; axis++)
        c.to_world[axis] = glm::dvec4(t.turn * glm::dvec3(c.to_world[axis]), 0);
    c.to_world[3] = glm::dvec4(t.point(glm::dvec3(c.to_world[3])), 1);
    c.near_clip *= t.scale, c.far_clip *= t.scale;
    c.focus_distance *= t.scale, c.aperture_radius *= t.scale;
    return c;
}

/// The same picture, but for lengths and places.
inline Scene placed(Scene scene, const Placement& t) {
    for (Shape& shape : scene.shapes)
        shape.geometry =
            std::visit([&](const auto& g) { return Geometry(placed(g, t)); }, shape.geometry);
    for (Emitter& emitter : scene.emitters)
        emitter = std::visit([&](const auto& e) { return placed(e, t); }, emitter);
    scene.camera = placed(scene.camera, t);
    return scene;
}

/// All places rounded to multiples of 2^-20, so that moves by as coarse numbers up to 2^32 are
/// exact.
inline Scene with_coarse_places(Scene scene) {
    auto snap = [](glm::dvec3& p) {
        p = glm::dvec3(std::round(p.x * 0x1p20), std::round(p.y * 0x1p20),
                       std::round(p.z * 0x1p20)) *
            0x1p-20;
    };
    for (Shape& shape : scene.shapes) {
        if (auto* mesh = std::get_if<Mesh>(&shape.geometry))
            for (glm::dvec3& p : mesh->positions)
                snap(p);
        if (auto* sphere = std::get_if<Sphere>(&shape.geometry)) snap(sphere->center);
        if (auto* disk = std::get_if<Disk>(&shape.geometry)) snap(disk->center);
        if (auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) snap(cylinder->base);
    }
    auto snap_place = [&](auto& emitter) {
        if constexpr (requires { emitter.position; }) snap(emitter.position);
    };
    for (Emitter& emitter : scene.emitters)
        std::visit(snap_place, emitter);
    glm::dvec3 camera(scene.camera.to_world[3]);
    snap(camera);
    scene.camera.to_world[3] = glm::dvec4(camera, 1);
    return scene;
}

/// A small scene of every kind, without AOVs, for moves that are exact.
inline Scene movable_scene() {
    Scene scene = with_coarse_places(every_kind_scene());
    scene.film.width = scene.film.crop_width = scene.film.height = scene.film.crop_height = 16;
    scene.camera.fov_degrees = 90; // some sky beside the walls
    scene.sampler.samples_per_pixel = 8;
    scene.integrator.aovs.clear();
    return scene;
}

} // namespace parhelion::numerics
