// The six facts every renderer starts from, each by its name; on the host, in both precisions.
#include <catch2/catch.hpp>

#include "host/numerics/materials.h"

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

MaterialCase diffuse_case(std::array<double, 3> reflectance) {
    MaterialCase c{};
    c.kind = material_diffuse;
    c.reflectance = reflectance;
    return c;
}

/// Textbook unpolarised Fresnel reflectance: cosine on this side, n = index beyond / index here.
long double textbook_fresnel(long double c, long double n) {
    long double sine_beyond = sqrtl(1 - c * c) / n;
    if (sine_beyond >= 1) return 1;
    long double c_beyond = sqrtl(1 - sine_beyond * sine_beyond);
    long double s = (c - n * c_beyond) / (c + n * c_beyond),
                p = (n * c - c_beyond) / (n * c + c_beyond);
    return (s * s + p * p) / 2;
}

} // namespace

TEMPLATE_TEST_CASE("Seed a: the diffuse BRDF is k_d / pi on the upper hemisphere and 0 below",
                   "[seed]", F32, F64) {
    auto m = make_material<TestType>(diffuse_case({0.8, 0.4, 0.1}));
    Random random(1);
    for (int n = 0; n < 1000; n++) {
        auto wo = random.direction<TestType>(), wi = random.direction<TestType>();
        auto e = bsdf_eval(m, wo, wi);
        bool above = wo.z > 0 && wi.z > 0;
        double cosine = above ? wi.z : 0;
        CHECK(e.f.x == Approx(0.8 / M_PI * cosine).epsilon(1e-6));
        CHECK(e.f.y == Approx(0.4 / M_PI * cosine).epsilon(1e-6));
        CHECK(e.f.z == Approx(0.1 / M_PI * cosine).epsilon(1e-6));
        CHECK(e.pdf == Approx(cosine / M_PI).epsilon(1e-6));
    }
}

TEMPLATE_TEST_CASE("Seed b: mirror reflection in the tangent frame", "[seed]", F32, F64) {
    Random random(2);
    for (int n = 0; n < 1000; n++) {
        auto w = random.direction<TestType>();
        auto r = reflect_local(w);
        CHECK((r.x == -w.x && r.y == -w.y && r.z == w.z));
        // The same in a frame about any normal: angle to the normal kept, and all three in one
        // plane.
        auto frame = frame_from_normal(random.direction<TestType>());
        auto world = to_world(frame, w), mirrored = to_world(frame, r),
             about = reflect_about(world, frame.n);
        CHECK(length3(sub3(mirrored, about)) < 1e-6);
        CHECK(dot3(mirrored, frame.n) == Approx(dot3(world, frame.n)).margin(1e-6));
        CHECK(dot3(cross3(world, frame.n), mirrored) == Approx(0).margin(1e-6));
    }
}

TEMPLATE_TEST_CASE(
    "Seed c: dielectric refraction, from below the indices swap and z flips, zero on total "
    "internal reflection",
    "[seed]", F32, F64) {
    const double n_below = 1.5;
    auto outside = interface_of<TestType>(n_below), inside = interface_of<TestType>(1 / n_below);
    Random random(3);
    int total = 0;
    for (int n = 0; n < 10000; n++) {
        auto w = random.direction<TestType>();
        auto t = refract_local(w, w.z > 0 ? outside : inside);
        double eta = w.z > 0 ? n_below : 1 / n_below;
        double k = 1 - (1 - double(w.z) * w.z) / (eta * eta);
        if (std::fabs(k) < 1e-6)
            continue; // which side of the critical angle: tested with more digits elsewhere
        if (k < 0) {
            CHECK((t.x == 0 && t.y == 0 && t.z == 0));
            total++;
            continue;
        }
        CHECK(t.x == Approx(-w.x / eta).margin(1e-6));
        CHECK(t.y == Approx(-w.y / eta).margin(1e-6));
        CHECK(t.z == Approx(w.z > 0 ? -std::sqrt(k) : std::sqrt(k)).epsilon(1e-3).margin(1e-6));
        if (k > 1e-3) CHECK(t.z == Approx(w.z > 0 ? -std::sqrt(k) : std::sqrt(k)).epsilon(1e-4));
    }
    // From below, directions within acos of the critical cosine of the plane: sqrt(1 - 1/n^2) / 2
    // of the whole sphere.
    CHECK(total == Approx(10000 * std::sqrt(1 - 1 / (n_below * n_below)) / 2).epsilon(0.05));
}

TEMPLATE_TEST_CASE("Seed d: unpolarised Fresnel of a dielectric", "[seed]", F32, F64) {
    using Real = typename TestType::Real;
    auto glass = interface_of<TestType>(1.5), from_glass = interface_of<TestType>(1 / 1.5);
    CHECK(fresnel_dielectric(Real(1), glass).reflectance == Approx(0.04).epsilon(1e-6));
    CHECK(fresnel_dielectric(Real(1), from_glass).reflectance == Approx(0.04).epsilon(1e-6));
    CHECK(fresnel_dielectric(Real(0), glass).reflectance == Real(1));
    CHECK(fresnel_dielectric(Real(0), glass).transmittance == Real(0));
    // At Brewster's angle only the s part is reflected: ((n^2 - 1) / (n^2 + 1))^2 / 2.
    double brewster = std::cos(std::atan(1.5));
    CHECK(fresnel_dielectric(Real(brewster), glass).reflectance ==
          Approx(f64::square(1.25 / 3.25) / 2).epsilon(1e-6));
    CHECK(fresnel_dielectric(Real(0.1), from_glass).reflectance ==
          Real(1)); // beyond the critical angle
    for (int n = 0; n <= 1000; n++) {
        Real c = Real(n / 1000.0);
        CHECK(fresnel_dielectric(c, glass).reflectance ==
              Approx(double(textbook_fresnel(c, 1.5L))).epsilon(2e-6));
        CHECK(fresnel_dielectric(c, from_glass).reflectance ==
              Approx(double(textbook_fresnel(c, 1 / 1.5L))).epsilon(2e-5));
    }
}

TEST_CASE("Seed e: shading normals are interpolated by barycentrics", "[seed]") {
    Random random(5);
    for (int n = 0; n < 1000; n++) {
        f32::vec3 normals[3], corners[3];
        for (int i = 0; i < 3; i++)
            normals[i] = random.direction<F32>(), corners[i] = random.point<F32>(2);
        f32::Vertex v{};
        v.n0x = normals[0].x, v.n0y = normals[0].y, v.n0z = normals[0].z;
        v.n1x = normals[1].x, v.n1y = normals[1].y, v.n1z = normals[1].z;
        v.n2x = normals[2].x, v.n2y = normals[2].y, v.n2z = normals[2].z;
        f32::Primitive p{};
        p.ax = corners[0].x, p.ay = corners[0].y, p.az = corners[0].z;
        p.bx = corners[1].x, p.by = corners[1].y, p.bz = corners[1].z;
        p.cx = corners[2].x, p.cy = corners[2].y, p.cz = corners[2].z;
        p.extra = inverse_normal_length(p);
        p.flags = geometry_triangle | PRIMITIVE_NORMALS;
        f32::vec2 b = f32::triangle_uniform(random.square<F32>());
        auto sum =
            f64::interpolate3(wide(normals[0]), wide(normals[1]), wide(normals[2]), b.x, b.y);
        if (f64::length3(sum) < 0.1) continue; // normals that cancel have no direction to speak of
        auto truth = f64::normalize3(sum);
        auto s = surface_vertex_attributes(surface_triangle(p, b.x, b.y), p, v, b.x, b.y);
        CHECK(f64::length3(f64::sub3(wide(s.ns), truth)) < 3e-6);
        CHECK(std::fabs(f64::length3(wide(s.ns)) - 1) < 3e-7);
        p.flags = geometry_triangle; // without normals the shading normal is the geometric one
        s = surface_vertex_attributes(surface_triangle(p, b.x, b.y), p, v, b.x, b.y);
        CHECK((s.ns.x == s.ng.x && s.ns.y == s.ng.y && s.ns.z == s.ng.z));
    }
    // At a corner the normal is that corner's own.
    f32::Vertex v{};
    v.n0x = 1, v.n1y = 1, v.n2z = 1;
    CHECK(f32::interpolated_normal(v, 0, 0).x == 1);
    CHECK(f32::interpolated_normal(v, 1, 0).y == 1);
    CHECK(f32::interpolated_normal(v, 0, 1).z == 1);
}

TEMPLATE_TEST_CASE(
    "Seed f: direct light of point lights is radiance x BRDF x cosine, summed over the lights",
    "[seed]", F32, F64) {
    using Real = typename TestType::Real;
    const double intensity[3] = {3, 20, 7}, x[3] = {0, 1, -2}, height[3] = {2, 5, -1};
    auto m = make_material<TestType>(diffuse_case({0.5, 0.25, 1}));
    auto wo = vec<TestType>(0.6, 0, 0.8), p = vec<TestType>(0, 0, 0), sum = vec<TestType>(0, 0, 0);
    double truth = 0;
    for (int i = 0; i < 3; i++) {
        typename TestType::Light l{};
        l.kind = emitter_point;
        l.ax = Real(x[i]), l.az = Real(height[i]);
        l.r = l.g = l.b = Real(intensity[i]);
        l.pmf = Real(1); // each light is asked, none is picked
        auto e = emitter_sample(l, p, {Real(0.5), Real(0.5)});
        sum = add3(sum, mul3(bsdf_eval(m, wo, e.wi).f, e.weight));
        double squared = x[i] * x[i] + height[i] * height[i];
        if (height[i] > 0) truth += intensity[i] / squared / M_PI * height[i] / std::sqrt(squared);
    }
    CHECK(sum.x == Approx(0.5 * truth).epsilon(1e-6));
    CHECK(sum.y == Approx(0.25 * truth).epsilon(1e-6));
    CHECK(sum.z == Approx(truth).epsilon(1e-6));
}
