// The five sets of rays of a small path tracer.
#include "benchmarks/native/ray_sets.h"

#include "host/shared_maths.h"

#include <array>
#include <cmath>

namespace parhelion::bench {
namespace {

using f32::vec3;

vec3 vector(const Point& p) { return {p.x, p.y, p.z}; }

Ray make_ray(const vec3& origin, const vec3& direction, float t_max, int excluded) {
    return {
        {origin.x, origin.y, origin.z}, {direction.x, direction.y, direction.z}, t_max, excluded};
}

std::vector<Ray> camera_rays(const TriangleScene& scene, int resolution) {
    constexpr int side = 4;
    vec3 forward = f32::normalize3(f32::sub3(vector(scene.target), vector(scene.eye)));
    vec3 right = f32::normalize3(f32::cross3(forward, {0, 1, 0}));
    vec3 up = f32::cross3(right, forward);
    double half = std::tan(scene.fov_degrees * M_PI / 360);
    auto across = [&](int pixel) { return float((2 * (pixel + 0.5) / resolution - 1) * half); };
    std::vector<Ray> rays;
    rays.reserve(static_cast<std::size_t>(resolution) * resolution);
    for (int block_y = 0; block_y < resolution; block_y += side)
        for (int block_x = 0; block_x < resolution; block_x += side)
            for (int k = 0; k < side * side; k++) {
                float x = across(block_x + k % side), y = -across(block_y + k / side);
                vec3 d = f32::add3(forward, f32::add3(f32::scale3(right, x), f32::scale3(up, y)));
                rays.push_back(make_ray(vector(scene.eye), f32::normalize3(d),
                                        std::numeric_limits<float>::infinity(), -1));
            }
    return rays;
}

f32::Primitive corners(const PrimitiveRecord& r) {
    f32::Primitive p{};
    p.ax = r.ax, p.ay = r.ay, p.az = r.az;
    p.bx = r.bx, p.by = r.by, p.bz = r.bz;
    p.cx = r.cx, p.cy = r.cy, p.cz = r.cz;
    vec3 a = f32::primitive_a(p), e1 = f32::sub3(f32::primitive_b(p), a),
         e2 = f32::sub3(f32::primitive_c(p), a);
    p.extra = 1.f / f32::length3(f32::cross3(e1, e2));
    return p;
}

struct NextRays {
    std::vector<Ray> bounce, shadow;
};

/// From every hit one ray on and one to the light.
NextRays next_rays(const TriangleScene& scene, std::span<const PrimitiveRecord> primitives,
                   std::span<const Ray> rays, std::span<const Hit> hits, int depth) {
    NextRays next;
    for (std::size_t i = 0; i < rays.size(); i++) {
        const Hit& hit = hits[i];
        if (hit.primitive < 0) continue;
        f32::SurfaceInteraction s = f32::surface_triangle(
            corners(primitives[static_cast<std::size_t>(hit.primitive)]), hit.b1, hit.b2);
        const std::array<float, 3>& d = rays[i].direction;
        vec3 n = f32::dot3(s.ng, {d[0], d[1], d[2]}) > 0 ? f32::neg3(s.ng) : s.ng;
        f32::Random4 u =
            f32::random4(static_cast<f32::Uint>(i), 0, static_cast<f32::Uint>(depth), 1);
        vec3 wi = f32::to_world(f32::frame_from_normal(n),
                                f32::hemisphere_cosine(f32::uniform2(u.x, u.y)));
        vec3 origin = f32::leave_surface(s.p, f32::surface_clearance(s.error, s.ng), s.ng, wi);
        next.bounce.push_back(
            make_ray(origin, wi, std::numeric_limits<float>::infinity(), hit.primitive));
        vec3 light = f32::add3(vector(scene.light_corner),
                               f32::add3(f32::scale3(vector(scene.light_u), f32::uniform01(u.z)),
                                         f32::scale3(vector(scene.light_v), f32::uniform01(u.w))));
        vec3 leaving = f32::leave_surface(s.p, f32::surface_clearance(s.error, s.ng), s.ng,
                                          f32::sub3(light, s.p));
        next.shadow.push_back(make_ray(leaving, f32::sub3(light, leaving), 1.f, hit.primitive));
    }
    return next;
}

} // namespace

std::vector<RaySet> make_ray_sets(const TriangleScene& scene,
                                  std::span<const PrimitiveRecord> primitives, int resolution,
                                  Tracer& reference) {
    std::vector<Ray> camera = camera_rays(scene, resolution);
    std::vector<Hit> hits;
    trace_all(reference, camera, 0, false, &hits);
    NextRays first = next_rays(scene, primitives, camera, hits, 1);
    trace_all(reference, first.bounce, 1, false, &hits);
    NextRays second = next_rays(scene, primitives, first.bounce, hits, 2);
    return {{"primary", 0, false, true, std::move(camera)},
            {"bounce 1", 1, false, false, std::move(first.bounce)},
            {"bounce 2", 2, false, false, std::move(second.bounce)},
            {"shadow from primary", 0, true, true, std::move(first.shadow)},
            {"shadow from bounce 1", 1, true, false, std::move(second.shadow)}};
}

} // namespace parhelion::bench
