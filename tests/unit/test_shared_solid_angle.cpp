// Triangles seen from a point: their solid angle to the last digits, and points uniform in it.
#include <catch2/catch.hpp>

#include "host/numerics/measure.h"
#include "host/numerics/seen_triangles.h"
#include "host/numerics/statistics.h"

#include <algorithm>

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

template<class P>
auto seen(const Corners& c) {
    return spherical_triangle(vec_as<P>(c[0]), vec_as<P>(c[1]), vec_as<P>(c[2]), true);
}

} // namespace

TEST_CASE("Solid angle: of triangles from 1e-3 to 6 sr within 2e-6, more where they are seen from "
          "the side",
          "[emitter]") {
    Random random(91);
    Worst error;
    for (int n = 0; n < 200000; n++) {
        Corners c = triangle_ahead(random, random.log_between(0.02, 3));
        long double truth = solid_angle_truth(c);
        if (truth < SOLID_ANGLE_LEAST || truth > 6) continue;
        error.add(double(std::fabs(seen<F32>(c).solid_angle / truth - 1)) * facing(c));
    }
    CHECK(error.value() < 2e-6);
}

TEST_CASE("Solid angle: an octant is pi / 2, a degenerate triangle nothing", "[emitter]") {
    CHECK(seen<F32>({f32::v3(2, 0, 0), f32::v3(0, 3, 0), f32::v3(0, 0, 0.5f)}).solid_angle ==
          Approx(M_PI / 2).epsilon(1e-6));
    f32::vec3 a = f32::v3(1, 2, 3), b = f32::v3(2, 1, 0), origin = f32::v3(0, 0, 0);
    CHECK(seen<F32>({a, a, b}).solid_angle == 0);
    CHECK(seen<F32>({a, origin, b}).solid_angle == 0); // seen from its own corner
}

TEST_CASE("Solid angle: any part of a triangle is hit as often as it is large", "[emitter]") {
    Random random(92);
    std::vector<double> p_values;
    auto test = [&](const Corners& c) {
        auto triangle = seen<F32>(c);
        if (triangle.solid_angle < SOLID_ANGLE_LEAST) return;
        // 4 x 4 cells: shares of the solid angle from corner 0, cut by arcs from corner 1.
        const int count = 200000;
        std::vector<double> observed(16), expected;
        for (int n = 0; n < count; n++) {
            f32::vec3 w = spherical_triangle_uniform(triangle, random.square<F32>());
            f64::vec3 v = wide(w);
            // The point's own sub-triangle: its side from corner 1 through w.
            f64::vec3 side = f64::cross3(wide(c[1]), v), far = f64::cross3(wide(c[0]), wide(c[2]));
            f64::vec3 cut = f64::cross3(far, side);
            f64::vec3 between = f64::add3(f64::normalize3(wide(c[0])), f64::normalize3(wide(c[2])));
            if (f64::dot3(cut, between) < 0) cut = f64::neg3(cut);
            auto part = f64::spherical_triangle(wide(c[0]), wide(c[1]), cut, true);
            double x = part.solid_angle / seen<F64>(c).solid_angle;
            double to_cut = 1 - f64::dot3(f64::normalize3(wide(c[1])), f64::normalize3(cut));
            double y = (1 - f64::dot3(f64::normalize3(wide(c[1])), v)) / to_cut;
            auto cell = [](double u) { return std::size_t(std::clamp(u, 0.0, 0.999999) * 4); };
            observed[cell(x) * 4 + cell(y)]++;
        }
        expected.assign(16, count / 16.0);
        p_values.push_back(chi_square_p(observed, expected));
    };
    for (double size : {0.05, 0.4, 1.0, 3.0})
        for (int repeat = 0; repeat < 4; repeat++)
            test(triangle_ahead(random, size));
    for (double apart : {0.1, 1e-2, 1e-3, 1e-4})
        for (int repeat = 0; repeat < 4; repeat++)
            test(triangle_beside(random, apart));
    CHECK(p_values.size() > 26);
    double level = sidak_level(0.01, p_values.size());
    for (double p : p_values)
        CHECK(p > level);
}

TEST_CASE("Solid angle: directions in single precision are those of double", "[emitter]") {
    Random random(93);
    Worst error, unit;
    for (int n = 0; n < 200000; n++) {
        Corners c = triangle_ahead(random, random.log_between(0.05, 2));
        auto triangle = seen<F32>(c);
        auto truth = seen<F64>(c);
        if (truth.solid_angle < SOLID_ANGLE_LEAST || truth.solid_angle > 6) continue;
        f32::vec2 u = random.square<F32>();
        f32::vec3 w = spherical_triangle_uniform(triangle, u);
        f64::vec3 w64 = spherical_triangle_uniform(truth, f64::v2(u.x, u.y));
        unit.add(std::fabs(f64::length3(wide(w)) - 1));
        error.add(f64::length3(f64::sub3(wide(w), w64)) / std::sqrt(truth.solid_angle));
    }
    CHECK(unit.value() < 2e-5);
    CHECK(error.value() < 2e-3); // of the triangle's width; the worst are needles
}

TEST_CASE("Solid angle: from next to any side, directions have length one", "[emitter]") {
    Random random(99);
    Worst unit;
    for (int n = 0; n < 50000; n++) {
        auto triangle = seen<F32>(triangle_beside(random, random.log_between(1e-4, 0.3)));
        f32::vec3 w = spherical_triangle_uniform(triangle, random.square<F32>());
        unit.add(std::fabs(f64::length3(wide(w)) - 1));
    }
    CHECK(unit.value() < 5e-4);
}

TEST_CASE("Solid angle: at the ends of the unit interval directions are finite", "[emitter]") {
    Random random(94);
    for (int n = 0; n < 20000; n++) {
        auto triangle = seen<F32>(triangle_ahead(random, random.log_between(0.02, 3)));
        if (triangle.solid_angle < SOLID_ANGLE_LEAST) continue;
        for (float x : {0.f, 0.5f, 1 - 0x1p-24f})
            for (float y : {0.f, 0.5f, 1 - 0x1p-24f})
                if (!f32::finite3(spherical_triangle_uniform(triangle, {x, y})))
                    FAIL(triangle.solid_angle << " at " << x << ", " << y);
    }
    SUCCEED();
}
