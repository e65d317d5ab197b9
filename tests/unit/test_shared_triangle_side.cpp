// Rays that start near triangles, in float against quadruple precision: none hits what is behind
// it, none misses what is ahead, however near.
#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include "host/numerics/measure.h"

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

using Exact = __float128;
struct Exact3 {
    Exact x, y, z;
};

Exact3 exact(f32::vec3 v) { return {v.x, v.y, v.z}; }
Exact3 operator-(const Exact3& a, const Exact3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Exact3 cross(const Exact3& a, const Exact3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Exact dot(const Exact3& a, const Exact3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
int sign(Exact x) { return (x > 0) - (x < 0); }

struct Triangle {
    f32::vec3 a, b, c;
};

struct Ray {
    f32::vec3 origin, direction;
    int z; // largest axis of the direction
    f32::RayShear shear;
};

f32::vec3 renamed(f32::vec3 v, int z) {
    if (z == 2) return v;
    return z == 0 ? f32::v3(v.y, v.z, v.x) : f32::v3(v.z, v.x, v.y);
}

f32::Corners renamed(const Triangle& t, const Ray& r) {
    return {renamed(t.a, r.z), renamed(t.b, r.z), renamed(t.c, r.z)};
}

Ray make_ray(f32::vec3 origin, f32::vec3 direction, double extent) {
    f32::vec3 size = f32::abs3(direction);
    Ray r{origin, direction, 2, {}};
    if (size.x > size.y && size.x > size.z) r.z = 0;
    if (size.y >= size.x && size.y > size.z) r.z = 1;
    f32::vec3 d = renamed(direction, r.z);
    r.shear.origin = renamed(origin, r.z);
    r.shear.shear_x = d.x / d.z;
    r.shear.shear_y = d.y / d.z;
    r.shear.shear_z = 1 / d.z;
    r.shear.doubt = f32::ray_doubt(r.shear.shear_z, float(extent));
    return r;
}

/// 1: ahead of the origin, -1: behind it, 0: through it or along it; and whether it is hit at all
/// (on the line).
struct Truth {
    int side;
    bool inside;
};

Truth truth(const Ray& r, const Triangle& t) {
    Exact3 o = exact(r.origin), d = exact(r.direction);
    Exact3 a = exact(t.a) - o, b = exact(t.b) - o, c = exact(t.c) - o;
    Exact3 n = cross(b - a, c - a);
    int u = sign(dot(d, cross(c, b))), v = sign(dot(d, cross(a, c))), w = sign(dot(d, cross(b, a)));
    bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
    return {sign(dot(n, a)) * sign(dot(n, d)), inside};
}

bool hits(const Ray& r, const Triangle& t) {
    f32::Corners v = renamed(t, r);
    bool hit = f32::intersect_triangle(v, r.shear, INFINITY).hit;
    if (f32::triangle_occludes(v, r.shear, INFINITY) != hit)
        FAIL_CHECK("blocking a ray and hitting it differ at the near end");
    return hit;
}

/// Along one axis.
void one_corner_away(Random& random, Triangle& t, double by) {
    f32::vec3* corners[] = {&t.a, &t.b, &t.c};
    f32::vec3& corner = *corners[random.bits() % 3];
    float* axes[] = {&corner.x, &corner.y, &corner.z};
    *axes[random.bits() % 3] += float(random.sign() * by);
}

f64::vec3 mix(const f64::vec3& a, const f64::vec3& b, double s) {
    return f64::add3(f64::scale3(a, 1 - s), f64::scale3(b, s));
}

/// A parallelogram of two triangles, its common edge from corner 0 to corner 2.
struct Sheet {
    f32::vec3 corner[4];
    Triangle first() const { return {corner[0], corner[1], corner[2]}; }
    Triangle second() const { return {corner[0], corner[2], corner[3]}; }
};

Sheet sheet(const f32::ShadingFrame& frame, f64::vec3 centre, double size, double slimness) {
    Sheet s;
    f64::vec3 u = f64::scale3(wide(frame.s), size), v = f64::scale3(wide(frame.t), size * slimness);
    for (int k = 0; k < 4; k++) {
        f64::vec3 p = f64::add3(centre, f64::scale3(u, k == 1 || k == 2 ? 1 : -1));
        s.corner[k] = vec_as<F32>(f64::add3(p, f64::scale3(v, k >= 2 ? 1 : -1)));
    }
    return s;
}

/// Around an axis, or any.
f32::ShadingFrame some_frame(Random& random, bool along_axes) {
    if (!along_axes) return f32::frame_from_normal(random.direction<F32>());
    f32::vec3 axis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    unsigned k = random.bits() % 3;
    return {axis[k], axis[(k + 1) % 3], axis[(k + 2) % 3]};
}

f32::Primitive primitive(const Triangle& t) {
    f32::Primitive p{};
    p.ax = t.a.x, p.ay = t.a.y, p.az = t.a.z;
    p.bx = t.b.x, p.by = t.b.y, p.bz = t.b.z;
    p.cx = t.c.x, p.cy = t.c.y, p.cz = t.c.z;
    p.extra = inverse_normal_length(p);
    return p;
}

/// From a point of the triangle, most often beside its edge from a to c, to either side;
/// `grazing`: the largest cosine to the normal.
Ray leave(Random& random, const Triangle& t, double grazing, double extent) {
    double b1 = random.bits() % 4 ? random.log_between(1e-9, 1e-3) : random.unit(),
           b2 = random.unit() * (1 - b1);
    f32::SurfaceInteraction s = f32::surface_triangle(primitive(t), float(b1), float(b2));
    double z = grazing * random.unit() * random.sign(), phi = random.between(0, 2 * M_PI),
           r = std::sqrt(1 - z * z);
    f32::vec3 w = f32::to_world(f32::frame_from_normal(s.ng),
                                vec<F32>(r * std::cos(phi), r * std::sin(phi), z));
    f32::vec3 clearance = f32::surface_clearance(s.error, s.ng);
    return make_ray(f32::leave_surface(s.p, clearance, s.ng, w), w, extent);
}

struct Count {
    int near = 0, wrong_hits = 0, misses = 0;

    void add(const Ray& r, const Triangle& t) {
        Truth is = truth(r, t);
        bool hit = hits(r, t);
        near += is.inside || hit;
        wrong_hits += hit && is.side <= 0;
        f32::Corners seen = f32::seen_from(renamed(t, r), r.shear.origin);
        bool inside =
            f32::settled_edges(renamed(t, r), f32::sheared(seen, r.shear), r.shear).inside;
        misses += !hit && is.side > 0 && inside && is.inside; // not: the neighbour's at an edge
    }
};

} // namespace

TEST_CASE("Two Reals: products and differences have twice the digits", "[two_real]") {
    Random random(81);
    int wrong = 0;
    auto value = [](f32::TwoReal x) { return Exact(x.high) + Exact(x.low); };
    for (int n = 0; n < 300000; n++) {
        float x[8];
        for (float& f : x)
            f = float(random.sign() * random.log_between(1e-3, 1e3));
        f32::TwoReal a = f32::two_difference(x[0], x[1]), b = f32::two_difference(x[2], x[3]),
                     c = f32::two_difference(x[4], x[5]), d = f32::two_difference(x[6], x[7]);
        wrong += value(a) != Exact(x[0]) - x[1];
        if (n % 2) c = a, d = b, d.low = float(d.low * 1.5); // cancels but for the last digits
        Exact ab = value(a) * value(b), cd = value(c) * value(d);
        Exact error = value(f32::two_difference_of_products(a, b, c, d)) - (ab - cd);
        Exact size = (ab < 0 ? -ab : ab) + (cd < 0 ? -cd : cd);
        wrong += (error < 0 ? -error : error) > size * 0x1p-43;
        error = value(f32::two_add(f32::two_multiply(a, b), c)) - (ab + value(c));
        size = (ab < 0 ? -ab : ab) + (value(c) < 0 ? -value(c) : value(c));
        wrong += (error < 0 ? -error : error) > size * 0x1p-43;
    }
    CHECK(wrong == 0);
}

TEST_CASE("Leaving one triangle of a flat sheet never hits the other, nor misses what is ahead",
          "[triangle_side]") {
    for (bool along_axes : {true, false})
        for (double offset : {0., 1., 1e4})
            for (double grazing : {1., 1e-3, 1e-6}) {
                Random random(82);
                Count count;
                for (int n = 0; n < 20000; n++) {
                    double size = n % 4 ? random.log_between(1e-3, 1e3)
                                        : random.log_between(1e-12, 1e12 / (offset + 1));
                    f64::vec3 centre = f64::scale3(random.direction<F64>(), offset * size);
                    Sheet s = sheet(some_frame(random, along_axes), centre, size,
                                    random.log_between(1e-2, 1));
                    count.add(leave(random, s.first(), grazing, 2 * size), s.second());
                }
                CAPTURE(along_axes, offset, grazing);
                CHECK(count.wrong_hits == 0);
                CHECK(count.misses == 0);
                CHECK((count.near > 30 || offset > 1));
            }
}

TEST_CASE("From within ulps of a triangle's plane, its side is the exact one", "[triangle_side]") {
    Random random(83);
    int near = 0, wrong = 0;
    for (int n = 0; n < 200000; n++) {
        // Also needles, and far from the coordinates' origin. (Below 1e-18 a determinant is
        // denormal.)
        double far = n % 5 == 1 ? random.log_between(1e2, 1e6) : 1; // of one corner
        // Products of three short sides of one with a far corner leave the range first.
        double size = random.log_between(far > 1 ? 1e-12 : 1e-15, 1e11 / far),
               offset = n % 3 ? 0 : 1e4;
        f64::vec3 centre = f64::scale3(random.direction<F64>(), offset * size),
                  along = f64::scale3(random.direction<F64>(), size);
        Triangle t{vec_as<F32>(f64::add3(centre, random.point<F64>(size))),
                   vec_as<F32>(f64::add3(centre, along)),
                   vec_as<F32>(f64::add3(centre, n % 5 ? random.point<F64>(size) : along))};
        if (n % 5 == 0) t.c = f32::add3(t.c, random.point<F32>(size * random.log_between(1e-6, 1)));
        if (n % 5 == 1) one_corner_away(random, t, size * far);
        auto part = [&] { // of one that reaches far, beside its other corners too
            double s = n % 5 == 1 ? random.log_between(1e-7, 1) : random.unit();
            return n % 2 ? s : 1 - s;
        };
        f64::vec3 on = mix(wide(t.a), mix(wide(t.b), wide(t.c), part()), part());
        f32::vec3 o = vec_as<F32>(f64::add3(on, random.point<F64>(size * 1e-7 * (n % 4))));
        Ray r = make_ray(o, random.direction<F32>(), 4 * size * far);
        f32::Corners s = f32::sheared(f32::seen_from(renamed(t, r), r.shear.origin), r.shear);
        f32::TriangleEdges e = f32::settled_edges(renamed(t, r), s, r.shear);
        if (!e.inside) continue;
        near++;
        // The plane's side is exact; the ray's side of it is what the edges saw.
        Exact3 a = exact(t.a) - exact(o);
        Exact3 normal = cross(exact(t.c) - exact(t.a), exact(t.b) - exact(t.a));
        Exact volume = dot(normal, a);
        double scale = f64::length3(f64::sub3(wide(t.b), wide(t.a))) *
                       f64::length3(f64::sub3(wide(t.c), wide(t.a))) *
                       f64::length3(f64::sub3(wide(t.a), wide(o)));
        if ((volume < 0 ? -volume : volume) <= 0x1p-42 * scale) continue; // promised digits
        int side = sign(volume) * sign(e.determinant) * sign(r.shear.shear_z);
        wrong += hits(r, t) != (side > 0);
    }
    CHECK(wrong == 0);
    CHECK(near > 20000);
}

TEST_CASE("Nothing leaks out of a box for rays that start within ulps of its edges and corners",
          "[triangle_side]") {
    const int faces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                             {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (bool along_axes : {true, false})
        for (double offset : {0., 100., 1e4}) {
            Random random(84);
            int leaks = 0, rays = 0, beside_all = 0;
            for (int n = 0; n < 20000; n++) {
                double size = random.log_between(1e-3, 1e3);
                f32::ShadingFrame f = some_frame(random, along_axes);
                f64::vec3 centre = f64::scale3(random.direction<F64>(), offset * size);
                f32::vec3 p[8];
                for (int k = 0; k < 8; k++) {
                    f64::vec3 v = f64::add3(f64::scale3(wide(f.s), k & 1 ? size : -size),
                                            f64::scale3(wide(f.t), k & 2 ? size : -size));
                    v = f64::add3(v, f64::scale3(wide(f.n), k & 4 ? size : -size));
                    p[k] = vec_as<F32>(f64::add3(centre, v));
                }
                std::vector<Triangle> box;
                for (auto& q : faces) {
                    box.push_back({p[q[0]], p[q[1]], p[q[2]]});
                    box.push_back({p[q[0]], p[q[2]], p[q[3]]});
                }
                f64::vec3 corner = wide(p[random.bits() % 8]), other = wide(p[random.bits() % 8]);
                f64::vec3 on = mix(corner, other, n % 3 ? random.unit() : 0);
                f32::vec3 o = vec_as<F32>(mix(on, centre, random.log_between(6e-8, 1e-5)));
                auto inside = [&](const Triangle& t) {
                    Exact3 normal = cross(exact(t.b) - exact(t.a), exact(t.c) - exact(t.a));
                    return sign(dot(normal, exact(t.a) - exact(o))) ==
                           sign(dot(normal, exact(t.a) - exact(vec_as<F32>(centre))));
                };
                if (!std::all_of(box.begin(), box.end(), inside)) continue;
                f32::vec3 d = random.direction<F32>();
                if (n % 2) d = f32::sub3(p[random.bits() % 8], o); // along faces, into corners
                if (n % 7 == 0) d = vec_as<F32>(f64::sub3(other, corner)); // along the edge
                if (f32::length3(d) == 0) continue;
                Ray r = make_ray(o, d, 4 * size);
                // An origin within the rounding of an edge can be outside for all edge tests.
                auto seen = [&](const Triangle& t) {
                    f32::Corners corners = f32::seen_from(renamed(t, r), r.shear.origin);
                    f32::Corners s = f32::sheared(corners, r.shear);
                    return f32::settled_edges(renamed(t, r), s, r.shear).inside;
                };
                if (std::none_of(box.begin(), box.end(), seen)) {
                    beside_all++;
                    continue;
                }
                rays++;
                leaks += std::none_of(box.begin(), box.end(),
                                      [&](const Triangle& t) { return hits(r, t); });
            }
            CAPTURE(along_axes, offset);
            CHECK(leaks == 0);
            CHECK(beside_all <= 1);
            CHECK(rays > 500);
        }
}
