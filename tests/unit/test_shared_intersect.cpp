// Rays against triangles, boxes, spheres and disks in float: nothing leaks, nothing is missed;
// distances against double.
#include <map>

#include <catch2/catch.hpp>

#include "host/numerics/measure.h"

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

struct Mesh {
    std::vector<f32::vec3> vertices;
    std::vector<std::array<std::size_t, 3>> triangles;
};

/// An octahedron, quartered `levels` times, its vertices pushed to the sphere and then at random:
/// closed and star-shaped.
Mesh rough_sphere(int levels, double scale, f64::vec3 centre, Random& random) {
    std::vector<f64::vec3> points = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                     {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    std::vector<std::array<std::size_t, 3>> faces;
    for (std::size_t x : {0u, 1u})
        for (std::size_t y : {2u, 3u})
            for (std::size_t z : {4u, 5u})
                faces.push_back({x, y, z});
    for (int level = 0; level < levels; level++) {
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
        auto middle = [&](std::size_t a, std::size_t b) {
            auto [at, is_new] = middles.try_emplace(std::minmax(a, b), points.size());
            if (is_new) points.push_back(f64::normalize3(f64::add3(points[a], points[b])));
            return at->second;
        };
        std::vector<std::array<std::size_t, 3>> finer;
        for (auto [a, b, c] : faces) {
            std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = finer;
    }
    Mesh mesh{{}, faces};
    for (f64::vec3 p : points) {
        f64::vec3 at = f64::add3(centre, f64::scale3(p, scale * random.between(0.9, 1.1)));
        mesh.vertices.push_back(vec_as<F32>(at));
    }
    return mesh;
}

/// The renaming of axes and the shear of kernels/device/traverse.h.
struct Ray {
    f32::vec3 origin, direction;
    int axis[3];
    f32::RayShear shear;
};

float axis_of(f32::vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

f32::vec3 renamed(const Ray& r, f32::vec3 v) {
    return f32::v3(axis_of(v, r.axis[0]), axis_of(v, r.axis[1]), axis_of(v, r.axis[2]));
}

Ray make_ray(f32::vec3 origin, f32::vec3 direction) {
    Ray r{origin, direction, {}, {}};
    float x = std::fabs(direction.x), y = std::fabs(direction.y), z = std::fabs(direction.z);
    r.axis[2] = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    r.axis[0] = (r.axis[2] + 1) % 3;
    r.axis[1] = (r.axis[2] + 2) % 3;
    float d = axis_of(direction, r.axis[2]);
    r.shear.origin = renamed(r, origin);
    r.shear.shear_x = axis_of(direction, r.axis[0]) / d;
    r.shear.shear_y = axis_of(direction, r.axis[1]) / d;
    r.shear.shear_z = 1 / d;
    r.shear.doubt = INFINITY;
    return r;
}

f32::Intersection hit_triangle(const Ray& r, f32::vec3 a, f32::vec3 b, f32::vec3 c) {
    f32::Corners corners = {renamed(r, a), renamed(r, b), renamed(r, c)};
    return f32::intersect_triangle(corners, r.shear, INFINITY);
}

bool hits_mesh(const Ray& r, const Mesh& mesh) {
    for (auto [a, b, c] : mesh.triangles)
        if (hit_triangle(r, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]).hit) return true;
    return false;
}

/// Leaks among rays from inside that aim at edges and vertices.
int count_leaks(double scale, f64::vec3 centre, int count) {
    Random random(61);
    Mesh mesh = rough_sphere(1, scale, centre, random);
    int leaks = 0;
    for (int n = 0; n < count; n++) {
        auto triangle = mesh.triangles[random.bits() % mesh.triangles.size()];
        f64::vec3 a = wide(mesh.vertices[triangle[n % 3]]),
                  b = wide(mesh.vertices[triangle[(n + 1) % 3]]);
        double along = n % 5 == 0 ? 0 : random.unit();
        f64::vec3 target = f64::add3(f64::scale3(a, 1 - along), f64::scale3(b, along));
        f32::vec3 origin = vec_as<F32>(f64::add3(centre, random.point<F64>(scale * 0.3)));
        leaks += !hits_mesh(make_ray(origin, f32::sub3(vec_as<F32>(target), origin)), mesh);
    }
    return leaks;
}

} // namespace

TEST_CASE("Triangles: no ray leaves a closed mesh through an edge or a vertex", "[intersect]") {
    CHECK(count_leaks(1, {0, 0, 0}, 400000) == 0);
    CHECK(count_leaks(1, {148376, 1234, -223423}, 200000) == 0);
    CHECK(count_leaks(4096, {0, 0, 0}, 200000) == 0);
    CHECK(count_leaks(1, {1e6, 1e6, 1e6}, 200000) == 0);
}

TEST_CASE("Triangles: distance and barycentrics against double, and misses miss", "[intersect]") {
    Random random(62);
    Worst distance, place;
    for (int n = 0; n < 300000; n++) {
        f32::vec3 corner[3];
        for (f32::vec3& c : corner)
            c = random.point<F32>(1);
        f64::vec3 a = wide(corner[0]), e1 = f64::sub3(wide(corner[1]), a),
                  e2 = f64::sub3(wide(corner[2]), a);
        double b1 = random.between(-0.5, 1.2), b2 = random.between(-0.5, 1.2);
        f32::vec3 origin = random.point<F32>(4);
        f64::vec3 target = f64::add3(a, f64::add3(f64::scale3(e1, b1), f64::scale3(e2, b2)));
        f32::vec3 direction = vec_as<F32>(f64::sub3(target, wide(origin)));
        f64::vec3 normal = f64::cross3(e1, e2), d = wide(direction);
        double facing = f64::dot3(normal, d) / f64::length3(normal) / f64::length3(d);
        if (std::fabs(facing) < 0.05 || f64::length3(normal) < 0.05)
            continue; // needles: tested by the leaks
        f32::Intersection i =
            hit_triangle(make_ray(origin, direction), corner[0], corner[1], corner[2]);
        double margin = std::min({b1, b2, 1 - b1 - b2});
        if (std::fabs(margin) < 1e-3) continue;
        if (i.hit != (margin > 0)) FAIL("margin " << margin);
        if (!i.hit) continue;
        double truth = f64::dot3(normal, f64::sub3(a, wide(origin))) / f64::dot3(normal, d);
        distance.add(std::fabs(i.t / truth - 1));
        place.add(std::max(std::fabs(i.b1 - b1), std::fabs(i.b2 - b2)));
    }
    CHECK(distance.value() <= 2e-5);
    CHECK(place.value() <= 1e-3);
}

TEST_CASE("Triangles: without texture coordinates the shading frame follows the first edge",
          "[intersect]") {
    Random random(29);
    for (int n = 0; n < 1000; n++) {
        f32::Primitive p{};
        p.ax = random.between(-1, 1), p.ay = random.between(-1, 1), p.az = random.between(-1, 1);
        p.bx = p.ax + 1, p.by = p.ay + random.between(-1, 1), p.bz = p.az;
        p.cx = p.ax, p.cy = p.ay + random.between(-.2, .2), p.cz = p.az + 1;
        p.extra = inverse_normal_length(p);
        f32::SurfaceInteraction s = f32::surface_triangle(p, .25f, .25f);
        f32::ShadingFrame frame = f32::surface_frame(s);
        f64::vec3 edge = f64::normalize3({p.bx - double(p.ax), p.by - double(p.ay), 0});
        CHECK(f64::length3(f64::sub3(wide(frame.s), edge)) < 1e-6);
        CHECK(std::fabs(f32::dot3(frame.s, s.ng)) < 1e-6);
    }
}

TEST_CASE("Triangles: blocking a ray is hitting it, but for the rounding of its far end",
          "[intersect]") {
    Random random(65);
    int hits = 0;
    for (int n = 0; n < 200000; n++) {
        double size = std::exp2(random.between(-40, 40));
        f32::vec3 corner[3];
        for (f32::vec3& c : corner)
            c = random.point<F32>(size);
        Ray r = make_ray(f32::v3(0, 0, 0), random.point<F32>(n % 2 ? size : 1));
        f32::Corners v = {renamed(r, corner[0]), renamed(r, corner[1]), renamed(r, corner[2])};
        f32::Intersection i = f32::intersect_triangle(v, r.shear, INFINITY);
        CHECK(f32::triangle_occludes(v, r.shear, INFINITY) == i.hit);
        if (!i.hit) continue;
        hits++;
        // Rounding goes with the size of the triangle, not with the distance to it.
        float size_z = std::max({std::fabs(v.a.z), std::fabs(v.b.z), std::fabs(v.c.z)});
        float rounding = 32 * std::exp2(-24.f) * size_z * std::fabs(r.shear.shear_z);
        CHECK(f32::triangle_occludes(v, r.shear, i.t + rounding));
        CHECK_FALSE(f32::triangle_occludes(v, r.shear, i.t - rounding));
    }
    CHECK(hits > 5000);
}

TEST_CASE("Triangles: without area they are never hit", "[intersect]") {
    Random random(63);
    for (int n = 0; n < 100000; n++) {
        f32::vec3 a = random.point<F32>(1), b = random.point<F32>(1);
        Ray r = make_ray(f32::v3(0, 0, -3), f32::sub3(a, f32::v3(0, 0, -3)));
        for (auto i :
             {hit_triangle(r, a, a, b), hit_triangle(r, a, b, b), hit_triangle(r, a, a, a)})
            if (i.hit) FAIL("hit a triangle without area");
    }
    SUCCEED();
}

TEST_CASE("Boxes: no box that a ray touches is missed, flat ones and rays along axes and in planes "
          "included",
          "[intersect]") {
    Random random(64);
    int misses = 0, hits = 0, needless = 0;
    for (int n = 0; n < 1000000; n++) {
        double offset = n % 3 == 0 ? 1e5 : 0;
        float low[3], high[3], origin[3], direction[3], target[3];
        for (int a = 0; a < 3; a++) {
            float x = float(offset + random.between(-1, 1)),
                  y = float(offset + random.between(-1, 1));
            low[a] = std::min(x, y), high[a] = random.bits() % 5 == 0 ? low[a] : std::max(x, y);
            target[a] = random.bits() % 4 == 0   ? high[a]
                        : random.bits() % 3 == 0 ? low[a]
                                                 : float(random.between(low[a], high[a]));
            origin[a] = float(offset + random.between(-4, 4));
            if (random.bits() % 4 == 0)
                origin[a] = target[a]; // parallel to this axis' planes, perhaps in one
            direction[a] = target[a] - origin[a];
            if (direction[a] == 0 && random.bits() % 2 == 0) direction[a] = -0.0f;
        }
        if (direction[0] == 0 && direction[1] == 0 && direction[2] == 0) continue;
        // In quadruple precision: the interval of t in which the ray is inside all three slabs.
        __float128 enter = 0, leave = 1e30;
        bool touches = true;
        float near[3], far[3];
        float largest =
            std::max({std::fabs(direction[0]), std::fabs(direction[1]), std::fabs(direction[2])});
        for (int a = 0; a < 3; a++) {
            f32::RaySlab slab = f32::ray_slab(origin[a], direction[a], largest, {0, 0});
            bool negative = slab.inverse < 0;
            float first = negative ? high[a] : low[a], last = negative ? low[a] : high[a];
            near[a] = std::fma(first, slab.inverse, slab.near_offset);
            far[a] = std::fma(last, slab.inverse, slab.far_offset);
            if (direction[a] == 0) {
                touches &= low[a] <= origin[a] && origin[a] <= high[a];
            } else {
                enter = std::max(enter, ((__float128)first - origin[a]) / direction[a]);
                leave = std::min(leave, ((__float128)last - origin[a]) / direction[a]);
            }
        }
        touches &= enter <= leave;
        bool found =
            f32::box_overlap(near[0], near[1], near[2], far[0], far[1], far[2], INFINITY).meets;
        hits += touches;
        misses += touches && !found;
        needless += !touches && found;
    }
    CHECK(misses == 0);
    CHECK(hits > 300000);
    CHECK(needless < 1000000 / 5); // aimed at corners and edges, so that rounding decides for many
    CHECK_FALSE(f32::box_overlap(1, 1, 1, 2, 2, 2, 0.5f).meets);             // beyond t_max
    CHECK_FALSE(f32::box_overlap(-2, -2, -2, -1, 1, 1, INFINITY).meets);     // behind
    CHECK_FALSE(f32::box_overlap(1, 3, 1, 2, 4, 2, INFINITY).meets);         // past it
    CHECK_FALSE(f32::box_overlap(INFINITY, 0, 0, INFINITY, 1, 1, 10).meets); // parallel and outside
}

TEST_CASE(
    "Spheres: the near and the far hit against double, from near and far, from outside and inside",
    "[intersect]") {
    Random random(65);
    Worst distance;
    int hits = 0;
    for (int n = 0; n < 500000; n++) {
        float radius = float(random.log_between(1e-3, 1e3));
        bool inside = n % 3 == 0;
        double away = inside ? random.unit() * 0.99 : random.log_between(1.001, 1e3);
        f32::vec3 origin = vec_as<F32>(f64::scale3(random.direction<F64>(), away * radius));
        f64::vec3 target =
            f64::scale3(random.direction<F64>(), radius * random.between(0, inside ? 1 : 1.3));
        f32::vec3 direction = vec_as<F32>(f64::sub3(target, wide(origin)));
        if (n % 2) direction = f32::scale3(direction, float(random.log_between(1e-2, 1e2)));
        f64::vec3 o = wide(origin), d = wide(direction);
        double a = f64::dot3(d, d), b = f64::dot3(o, d), r2 = double(radius) * radius;
        f64::vec3 foot = f64::sub3(o, f64::scale3(d, b / a));
        double discriminant = r2 - f64::dot3(foot, foot);
        // Where the ray only grazes, the chord is decided by rounding.
        if (std::fabs(discriminant) < 1e-2 * r2) continue;
        f32::Intersection i = f32::intersect_sphere(origin, direction, radius, INFINITY);
        double half = std::sqrt(std::max(discriminant, 0.0) / a), near = -b / a - half,
               far = -b / a + half;
        if (away > 100 && std::fabs(discriminant) < 0.1 * r2) continue;
        if (i.hit != (discriminant > 0 && far > 0)) FAIL("discriminant " << discriminant / r2);
        if (!i.hit) continue;
        hits++;
        double truth = near > 0 ? near : far;
        distance.add(std::fabs(i.t - truth) / (std::fabs(truth) + radius / std::sqrt(a)));
        if (f32::intersect_sphere(origin, direction, radius, float(truth * 0.99)).hit)
            FAIL("beyond t_max");
    }
    CHECK(hits > 100000);
    CHECK(distance.value() <= 1e-4);
}

TEST_CASE("Disks: hit, distance and coordinates against double", "[intersect]") {
    Random random(66);
    Worst distance, place;
    for (int n = 0; n < 300000; n++) {
        f32::ShadingFrame frame = f32::frame_from_normal(random.direction<F32>());
        float radius = float(random.log_between(1e-2, 1e2));
        f32::vec3 u = f32::scale3(frame.s, radius), v = f32::scale3(frame.t, radius);
        double x = random.between(-1.2, 1.2), y = random.between(-1.2, 1.2);
        f64::vec3 target = f64::add3(f64::scale3(wide(u), x), f64::scale3(wide(v), y));
        f32::vec3 origin =
            f32::scale3(random.direction<F32>(), radius * float(random.between(0.5, 10)));
        f32::vec3 direction = vec_as<F32>(f64::sub3(target, wide(origin)));
        double facing = f64::dot3(wide(frame.n), f64::normalize3(wide(direction)));
        double squared = x * x + y * y;
        if (std::fabs(facing) < 0.05 || std::fabs(squared - 1) < 1e-3) continue;
        f32::Intersection i = f32::intersect_disk(f32::neg3(origin), direction, u, v, INFINITY);
        if (i.hit != (squared < 1)) FAIL("at " << x << ", " << y);
        if (!i.hit) continue;
        distance.add(std::fabs(double(i.t) - 1));
        place.add(std::max(std::fabs(i.b1 - x), std::fabs(i.b2 - y)));
    }
    CHECK(distance.value() <= 3e-5);
    CHECK(place.value() <= 3e-4);
    f32::vec3 along = f32::v3(1, 0, 0), up = f32::v3(0, 1, 0);
    CHECK_FALSE(
        f32::intersect_disk(f32::v3(3, 0, 0), along, along, up, INFINITY).hit); // in its plane
    CHECK_FALSE(f32::intersect_disk(f32::v3(0, 0, 3), f32::v3(0, 0, 1), along, along, 9)
                    .hit); // no disk at all
}
