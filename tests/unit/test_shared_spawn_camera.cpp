// Rays that start: off a surface on the right side of it, and from the camera through film and
// lens.
#include <catch2/catch.hpp>

#include "host/numerics/measure.h"

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

f32::Primitive triangle_primitive(const f32::vec3 (&v)[3]) {
    f32::Primitive p{};
    p.ax = v[0].x, p.ay = v[0].y, p.az = v[0].z;
    p.bx = v[1].x, p.by = v[1].y, p.bz = v[1].z;
    p.cx = v[2].x, p.cy = v[2].y, p.cz = v[2].z;
    p.extra = inverse_normal_length(p);
    return p;
}

__float128 dot128(f64::vec3 a, f64::vec3 b) {
    return (__float128)a.x * b.x + (__float128)a.y * b.y + (__float128)a.z * b.z;
}

} // namespace

TEST_CASE("Leaving a triangle: always on the side of the plane that the ray goes to, at any size",
          "[spawn]") {
    Random random(71);
    int tested = 0, wrong = 0;
    for (int n = 0; n < 1000000; n++) {
        double size = random.log_between(1e-6, 1e6),
               offset = n % 2 ? size * random.log_between(1, 1e3) : 0;
        f64::vec3 centre = f64::scale3(random.direction<F64>(), offset);
        f32::vec3 v[3];
        for (f32::vec3& corner : v)
            corner = vec_as<F32>(f64::add3(centre, random.point<F64>(size)));
        f64::vec3 a = wide(v[0]);
        f64::vec3 e1 = f64::sub3(wide(v[1]), a), e2 = f64::sub3(wide(v[2]), a),
                  normal = f64::cross3(e1, e2);
        double longest = std::max(f64::length3(e1), f64::length3(e2));
        if (f64::length3(normal) < 1e-3 * longest * longest)
            continue; // needles: their normal is uncertain itself
        f32::vec2 b = f32::triangle_uniform(random.square<F32>());
        f32::SurfaceInteraction s = f32::surface_triangle(triangle_primitive(v), b.x, b.y);
        f32::vec3 w = random.direction<F32>();
        f32::vec3 q = f32::leave_surface(s.p, f32::surface_clearance(s.error, s.ng), s.ng, w);
        double side = f32::dot3(w, s.ng) > 0 ? 1 : -1;
        tested++;
        wrong += !(dot128(f64::sub3(wide(q), a), normal) * side > 0);
        // And no further than the bound promises.
        double moved = f64::length3(f64::sub3(wide(q), wide(s.p)));
        if (moved > 1e-5 * (f64::length3(wide(s.p)) + size))
            FAIL("moved " << moved << " at size " << size);
    }
    CHECK(wrong == 0);
    CHECK(tested > 500000);
}

TEST_CASE("Leaving a sphere or a disk: always on the side that the ray goes to", "[spawn]") {
    Random random(72);
    int wrong_sphere = 0, wrong_disk = 0;
    for (int n = 0; n < 300000; n++) {
        double size = random.log_between(1e-6, 1e6);
        f32::Primitive p{};
        f32::vec3 centre = vec_as<F32>(
            f64::scale3(random.direction<F64>(), n % 2 ? size * random.log_between(1, 1e3) : 0));
        p.ax = centre.x, p.ay = centre.y, p.az = centre.z;
        p.bx = 1, p.cz = 1;
        p.extra = float(size);
        f32::vec3 w = random.direction<F32>();
        f64::vec3 on = f64::add3(wide(centre), f64::scale3(random.direction<F64>(),
                                                           size * random.between(0.9999, 1.0001)));
        f32::SurfaceInteraction s = f32::surface_sphere(p, vec_as<F32>(on));
        f32::vec3 q = f32::leave_surface(s.p, f32::surface_clearance(s.error, s.ng), s.ng, w);
        f64::vec3 from_centre = f64::sub3(wide(q), wide(centre));
        __float128 beyond = dot128(from_centre, from_centre) - (__float128)p.extra * p.extra;
        bool outward = f32::dot3(w, s.ng) > 0;
        wrong_sphere += !(outward ? beyond > 0 : beyond < 0);

        f32::ShadingFrame frame = f32::frame_from_normal(random.direction<F32>());
        f32::vec3 u = f32::scale3(frame.s, p.extra), v = f32::scale3(frame.t, p.extra);
        p.bx = u.x, p.by = u.y, p.bz = u.z, p.cx = v.x, p.cy = v.y, p.cz = v.z;
        p.extra = float(1 / f64::length3(f64::cross3(wide(u), wide(v))));
        f32::vec2 at = f32::disk_uniform(random.square<F32>());
        s = f32::surface_disk(p, at.x, at.y);
        q = f32::leave_surface(s.p, f32::surface_clearance(s.error, s.ng), s.ng, w);
        f64::vec3 normal = f64::cross3(wide(u), wide(v));
        double side = f32::dot3(w, s.ng) > 0 ? 1 : -1;
        wrong_disk += !(dot128(f64::sub3(wide(q), wide(centre)), normal) * side > 0);
    }
    CHECK(wrong_sphere == 0);
    CHECK(wrong_disk == 0);
}

namespace {

/// A camera at (1, 2, 3) that looks along +z, film 200 x 100, half a unit to each side at
/// distance 1.
f32::Camera test_camera(float lens_radius) {
    f32::Camera c{};
    c.ox = 1, c.oy = 2, c.oz = 3;
    c.dx = 0.5f, c.dy = 0.25f, c.dz = 1; // top left
    c.ux = -1 / 200.f, c.vy = -0.5f / 100;
    c.lx = lens_radius, c.my = lens_radius;
    c.near_clip = 0.25f, c.far_clip = 40, c.focus_distance = 8;
    return c;
}

} // namespace

TEST_CASE(
    "Camera: rays start on the near plane, end on the far plane, and go through the film position",
    "[camera]") {
    Random random(73);
    for (float lens : {0.0f, 0.5f}) {
        f32::Camera c = test_camera(lens);
        for (int n = 0; n < 10000; n++) {
            f32::vec2 film = {float(random.between(0, 200)), float(random.between(0, 100))};
            f32::CameraRay r = f32::camera_ray(c, film, f32::disk_uniform(random.square<F32>()));
            CHECK(f32::length3(r.direction) == Approx(1).epsilon(1e-6));
            CHECK(r.origin.z - 3 == Approx(0.25).epsilon(1e-5));
            CHECK(r.origin.z + r.direction.z * r.t_max - 3 == Approx(40).epsilon(1e-5));
            if (lens > 0) continue;
            CHECK(r.direction.x / r.direction.z == Approx(0.5 - film.x / 200).margin(1e-6));
            CHECK(r.direction.y / r.direction.z == Approx(0.25 - film.y / 200).margin(1e-6));
        }
    }
}

TEST_CASE(
    "Camera: through whatever point of the lens, a film position sees the same point in focus",
    "[camera]") {
    Random random(74);
    f32::Camera sharp = test_camera(0), c = test_camera(0.5f);
    Worst blur, lens_reach;
    for (int n = 0; n < 10000; n++) {
        f32::vec2 film = {float(random.between(0, 200)), float(random.between(0, 100))};
        f32::CameraRay through_centre = f32::camera_ray(sharp, film, {0, 0});
        f32::CameraRay r = f32::camera_ray(c, film, f32::disk_uniform(random.square<F32>()));
        auto at_depth = [](f32::CameraRay ray, double z) {
            double t = (3 + z - ray.origin.z) / ray.direction.z;
            return f64::add3(wide(ray.origin), f64::scale3(wide(ray.direction), t));
        };
        blur.add(f64::length3(f64::sub3(at_depth(r, 8), at_depth(through_centre, 8))));
        lens_reach.add(f64::length3(f64::sub3(at_depth(r, 0), f64::v3(1, 2, 3))));
    }
    CHECK(blur.value() <= 1e-5);
    CHECK(lens_reach.value() <= 0.5001);
    CHECK(lens_reach.value() >= 0.49); // the whole aperture is used
}
