// Cylinders: hits against double, surfaces against Mitsuba's figures and the exact cylinder, and
// rays that leave them.
#include "host/numerics/measure.h"
#include "host/numerics/statistics.h"
#include "tests/support/first_hits.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>

using namespace parhelion;
using namespace parhelion::numerics;
using namespace parhelion::test;

namespace {

struct Tube {
    f32::vec3 axis; // unit
    float radius, height;
};

Tube random_tube(Random& random) {
    const double radius = random.log_between(1e-3, 1e3);
    return {random.direction<F32>(), float(radius), float(radius * random.log_between(0.1, 1e3))};
}

/// Where a ray is on the infinite cylinder, and how high there, in units of the height.
struct Crossing {
    double t, z;
};
struct Crossings {
    double clearness; ///< of the discriminant: 1 through the middle, 0 where it grazes
    double doubt;     ///< what rounding can do to it
    Crossing at[2];
};

Crossings crossings(const Tube& c, f32::vec3 origin, f32::vec3 direction) {
    const f64::vec3 n = f64::normalize3(wide(c.axis)), o = wide(origin), d = wide(direction);
    const f64::vec3 across_o = f64::sub3(o, f64::scale3(n, f64::dot3(o, n))),
                    across_d = f64::sub3(d, f64::scale3(n, f64::dot3(d, n)));
    const double a = f64::dot3(across_d, across_d), b = f64::dot3(across_o, across_d) / a,
                 radius = c.radius;
    const f64::vec3 foot = f64::sub3(across_o, f64::scale3(across_d, b));
    const double left = radius * radius - f64::dot3(foot, foot),
                 half = std::sqrt(std::max(left, 0.0) / a);
    Crossings result{
        left / (radius * radius), 1e-2 + 0x1p-18 * f64::length3(across_o) / radius, {}};
    for (int k : {0, 1}) {
        const double t = -b + (k ? half : -half);
        result.at[k] = {t, (f64::dot3(o, n) + t * f64::dot3(d, n)) / c.height};
    }
    return result;
}

/// `rounding`: of places along the axis, in heights.
bool near_an_end(const Crossings& c, double rounding) {
    const double margin = 1e-3 + 16 * rounding;
    return std::any_of(std::begin(c.at), std::end(c.at), [&](const Crossing& x) {
        return std::fabs(x.z) < margin || std::fabs(x.z - 1) < margin;
    });
}

} // namespace

TEST_CASE("Cylinders: the first hit between both ends against double", "[intersect]") {
    Random random(91);
    Worst distance;
    int hits = 0, insides = 0, misses = 0;
    for (int n = 0; n < 500000; n++) {
        const Tube c = random_tube(random);
        const double size = std::hypot(c.radius, c.height);
        const f64::ShadingFrame frame = f64::frame_from_normal(wide(c.axis));
        const double phi = random.between(0, 2 * M_PI), z = random.between(-0.2, 1.2);
        const f64::vec3 target = to_world(
            frame, f64::v3(c.radius * std::cos(phi), c.radius * std::sin(phi), z * c.height));
        const f32::vec3 origin = vec_as<F32>(f64::add3(
            target, f64::scale3(random.direction<F64>(), size * random.log_between(1e-2, 10))));
        f32::vec3 direction = vec_as<F32>(f64::sub3(target, wide(origin)));
        if (n % 2) direction = f32::scale3(direction, float(random.log_between(1e-2, 1e2)));
        const Crossings truth = crossings(c, origin, direction);
        // Where the ray only grazes, or ends count, rounding decides.
        if (std::fabs(truth.clearness) < truth.doubt ||
            near_an_end(truth, 0x1p-24 * f64::length3(wide(origin)) / c.height))
            continue;
        const double longest = std::max(std::fabs(truth.at[0].t), std::fabs(truth.at[1].t));
        if (std::min(std::fabs(truth.at[0].t), std::fabs(truth.at[1].t)) < 1e-4 * longest) continue;
        const Crossing* first = nullptr;
        for (const Crossing& x : truth.at)
            if (!first && truth.clearness > 0 && x.t > 0 && x.z > 0 && x.z < 1) first = &x;
        const f32::Intersection i =
            f32::intersect_cylinder(origin, direction, c.axis, c.radius, c.height, INFINITY);
        INFO("radius " << c.radius << ", height " << c.height << ", z " << truth.at[0].z << ", "
                       << truth.at[1].z << ", t " << truth.at[0].t << ", " << truth.at[1].t);
        if (i.hit != (first != nullptr)) FAIL("clearness " << truth.clearness);
        if (!i.hit) {
            misses++;
            continue;
        }
        hits++;
        insides += first == &truth.at[1];
        if (bool(i.back) != (first == &truth.at[1])) FAIL("the wrong side");
        distance.add(std::fabs(i.t - first->t) / (longest + size / f64::length3(wide(direction))));
        if (f32::intersect_cylinder(origin, direction, c.axis, c.radius, c.height,
                                    float(first->t * 0.99))
                .hit)
            FAIL("beyond t_max");
    }
    CHECK(hits > 100000);
    CHECK(insides > 10000);
    CHECK(misses > 10000);
    CHECK(distance.value() <= 1e-4);
}

TEST_CASE("Cylinders: rays along the axis, and cylinders of nothing, are no hits", "[intersect]") {
    const f32::vec3 z = f32::v3(0, 0, 1), out = f32::v3(-1, 0, 0);
    auto hit = [](f32::vec3 o, f32::vec3 d, f32::vec3 axis, float r, float h) {
        return f32::intersect_cylinder(o, d, axis, r, h, INFINITY).hit;
    };
    CHECK(hit(f32::v3(3, 0, 0.5f), out, z, 1, 1));
    CHECK_FALSE(hit(f32::v3(0.3f, 0, -2), z, z, 1, 1));
    CHECK_FALSE(hit(f32::v3(1, 0, -2), z, z, 1, 1)); // in its wall
    CHECK_FALSE(hit(f32::v3(3, 0, 0.5f), out, z, 0, 1));
    CHECK_FALSE(hit(f32::v3(3, 0, 0.5f), out, f32::v3(0, 0, 0), 1, 0));
    CHECK_FALSE(hit(f32::v3(3, 0, 1.5f), out, z, 1, 1));
}

TEST_CASE("Leaving a cylinder: always on the side that the ray goes to", "[spawn]") {
    Random random(92);
    int wrong = 0, again = 0, through = 0;
    for (int n = 0; n < 300000; n++) {
        const double size = random.log_between(1e-6, 1e6);
        const Tube unit = {random.direction<F32>(), float(size * random.log_between(1e-2, 1)),
                           float(size)};
        f32::Primitive p{};
        const f32::vec3 base = vec_as<F32>(
            f64::scale3(random.direction<F64>(), n % 2 ? size * random.log_between(1, 1e2) : 0));
        const f32::vec3 axis = f32::scale3(unit.axis, unit.height);
        p.ax = base.x, p.ay = base.y, p.az = base.z;
        p.bx = axis.x, p.by = axis.y, p.bz = axis.z;
        p.cx = 1;
        p.extra = unit.radius;
        const f64::vec3 exact = f64::normalize3(wide(axis));
        const f64::ShadingFrame frame = f64::frame_from_normal(exact);
        const double phi = random.between(0, 2 * M_PI), r = unit.radius;
        const f64::vec3 on =
            f64::add3(wide(base), to_world(frame, f64::v3(r * std::cos(phi), r * std::sin(phi),
                                                          size * random.between(0.1, 0.9))));
        const f32::SurfaceInteraction s = f32::surface_cylinder(p, vec_as<F32>(on));
        const f32::vec3 w = random.direction<F32>();
        const bool outward = f32::dot3(w, s.ng) > 0;
        const f32::vec3 q = f32::leave_surface(s.p, f32::surface_clearance(s.error, s.ng), s.ng, w);
        const f64::vec3 from = f64::sub3(wide(q), wide(base));
        const f64::vec3 across = f64::cross3(from, exact);
        const double beyond = f64::length3(across) / r - 1;
        wrong += outward ? !(beyond > 0) : !(beyond < 0);
        const f32::Intersection i =
            f32::intersect_cylinder(f32::sub3(q, base), w, f32::normalize3(axis), unit.radius,
                                    f32::length3(axis), INFINITY);
        again += outward && i.hit;
        // From inside the far wall is met, if no end is passed before.
        through += !outward && i.hit && i.back;
    }
    CHECK(wrong == 0);
    CHECK(again == 0);
    CHECK(through > 10000);
}

// A factor of radiative transfer in closed form: an element whose normal goes at right angles
// through one end of the axis, h away (Hamilton and Morgan 1952, configuration 3).
TEST_CASE("Cylinders: irradiance of a rod is that of the closed form", "[emitter]") {
    for (const auto& [r, l, h] : {std::array{0.5, 2.0, 1.5}, {0.1, 0.3, 4.0}, {1.0, 5.0, 3.0}}) {
        // In radii.
        const double length = l / r, far = h / r, x = (1 + far) * (1 + far) + length * length,
                     y = (1 - far) * (1 - far) + length * length;
        const double factor = std::atan(length / std::sqrt(far * far - 1)) / (M_PI * far) +
                              length / M_PI *
                                  ((x - 2 * far) / (far * std::sqrt(x * y)) *
                                       std::atan(std::sqrt(x * (far - 1) / (y * (far + 1)))) -
                                   std::atan(std::sqrt((far - 1) / (far + 1))) / far);
        f32::Light rod{};
        rod.kind = emitter_area_cylinder;
        rod.az = float(h), rod.bx = float(l), rod.cx = float(r);
        rod.r = rod.g = rod.b = 2, rod.pmf = 1, rod.extra = 1;
        rod.area = float(2 * M_PI * r * l);
        Random random(93);
        Mean mean;
        for (int n = 0; n < 400000; n++) {
            const f32::EmitterSample s =
                f32::emitter_area_cylinder_sample(rod, f32::v3(0, 0, 0), random.square<F32>());
            mean.add(double(s.weight.x) * s.wi.z);
        }
        INFO("radius " << r << ", length " << l << ", distance " << h);
        CHECK(std::fabs(mean.mean() - 2 * M_PI * factor) <= 4 * mean.error());
        CHECK(mean.error() < 0.01 * mean.mean());
    }
}

namespace {

struct Figure {
    glm::dvec3 origin, direction, p, n;
    glm::dvec2 uv;
};

/// One pixel looks along a ray at a cylinder of which Mitsuba 3.9.1 says this (ray_intersect).
void check_figure(const std::string& parameters, const Figure& f) {
    const glm::dvec3 target = f.origin + f.direction;
    const auto text = [](const glm::dvec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
    const Scene scene = scene_of_text(
        every_aov + "<shape type=\"cylinder\">" + parameters + "</shape>" +
        "<sensor type=\"perspective\"><float name=\"fov\" value=\"0.001\"/><transform "
        "name=\"to_world\"><lookat origin=\"" +
        text(f.origin) + "\" target=\"" + text(target) +
        "\" up=\"0.1,0.2,1\"/></transform><sampler type=\"independent\"><integer "
        "name=\"sample_count\" value=\"1\"/></sampler><film type=\"hdrfilm\"><integer "
        "name=\"width\" value=\"1\"/><integer name=\"height\" value=\"1\"/><string "
        "name=\"pixel_format\" value=\"rgba\"/><rfilter type=\"box\"/></film></sensor>");
    const FirstHit hit = first_hits(scene).at(0);
    REQUIRE(hit.hit);
    check_near(hit.p, f.p, 2e-4);
    check_near(hit.ng, f.n, 2e-4);
    check_near(hit.ns, f.n, 2e-4);
    CHECK(glm::length(hit.uv - f.uv) < 2e-4);
}

} // namespace

TEST_CASE("Cylinders: position, normal and texture coordinates are Mitsuba's", "[surface]") {
    const std::string flipped = "<boolean name=\"flip_normals\" value=\"true\"/>",
                      oblique = "<point name=\"p0\" x=\"1\" y=\"2\" z=\"3\"/><point name=\"p1\" "
                                "x=\"2\" y=\"4\" z=\"6\"/><float name=\"radius\" value=\"0.5\"/>",
                      mirrored = "<transform name=\"to_world\"><scale x=\"-1\"/></transform>",
                      turned = "<transform name=\"to_world\"><scale x=\"2\" y=\"2\" z=\"3\"/>"
                               "<rotate x=\"1\" angle=\"90\"/></transform>";
    check_figure("",
                 {{3, 0, 0.5}, {-1, 0.001, 0}, {1, 0.002, 0.5}, {1, 0.002, 0}, {0.0003183, 0.5}});
    check_figure("", {{0, 3, 0.25}, {0, -1, 0}, {0, 1, 0.25}, {0, 1, 0}, {0.25, 0.25}});
    // From inside, and through an open end.
    check_figure("", {{0.1, 0.2, 0.5},
                      {1, 0.2, 0.1},
                      {0.93057, 0.366114, 0.583057},
                      {0.93057, 0.366114, 0},
                      {0.0596559, 0.583057}});
    check_figure("", {{3, 0.01, 1.4},
                      {-1, 0, -0.35},
                      {0.99995, 0.01, 0.70},
                      {0.99995, 0.01, 0},
                      {0.0015916, 0.70}});
    check_figure(flipped, {{0, 3, 0.25}, {0, -1, 0}, {0, 1, 0.25}, {0, -1, 0}, {0.25, 0.25}});
    check_figure(oblique, {{5, 3.2, 4.7},
                           {-1, 0, 0},
                           {2.09259, 3.2, 4.7},
                           {0.957676, -0.0550267, -0.282541},
                           {0.00458314, 0.613757}});
    check_figure(oblique, {{1.6, 9, 4.7},
                           {0, -1, 0},
                           {1.6, 3.73042, 4.7},
                           {-0.108692, 0.843462, -0.526078},
                           {0.25488, 0.654346}});
    check_figure(mirrored, {{0.1, 0.2, 0.5},
                            {1, 0.2, 0.1},
                            {0.93057, 0.366114, 0.583057},
                            {0.93057, 0.366114, 0},
                            {0.440344, 0.583057}});
    check_figure(
        turned,
        {{5, -0.5, 1}, {-1, 0, 0}, {1.73205, -0.5, 1}, {0.866025, 0, 0.5}, {0.0833334, 0.166667}});
}

TEST_CASE("Cylinders: what is no round cylinder is refused", "[surface]") {
    using Catch::Matchers::Contains;
    const auto refused = [](const std::string& parameters) {
        return refusal_of_body("<shape type=\"cylinder\">\n" + parameters + "</shape>");
    };
    CHECK_THAT(refused("<transform name=\"to_world\"><scale x=\"2\"/></transform>"),
               Contains("scene.xml:3") && Contains("oval"));
    CHECK_THAT(refused("<transform name=\"to_world\"><matrix value=\"1 0 .5 0 0 1 0 0 0 0 1 0 0 0 "
                       "0 1\"/></transform>"),
               Contains("scene.xml:3") && Contains("oval or oblique"));
    CHECK_THAT(refused("<point name=\"p1\" x=\"0\" y=\"0\" z=\"0\"/>"),
               Contains("scene.xml:3") && Contains("the same as \"p0\""));
    CHECK_THAT(refused("<float name=\"radius\" value=\"0\"/>"), Contains("1e-100 to"));
    CHECK(refused("<transform name=\"to_world\"><scale x=\"2\" y=\"2\"/></transform>").empty());
}
