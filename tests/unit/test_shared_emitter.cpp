// Every emitter of the list: samples against density, density against a traced hit, irradiance
// against closed forms.
#include <catch2/catch.hpp>

#include "host/flatten/kind_names.h"
#include "host/numerics/materials.h"
#include "host/numerics/statistics.h"

using namespace parhelion;
using namespace parhelion::numerics;

namespace {

/// A row of the light table in double, and a ray's way to it.
struct LightCase {
    int kind;
    double a[3], b[3], c[3];
    double area;  // 0: not chosen by area
    double extra; // as the emitter's header says; of a disk the sign alone
    double pmf;
    double p[3]; // the point that receives light
};

/// Emitters with a plane keep the inverse length of its normal there.
double record_extra(const LightCase& c) {
    auto vector = [](const double(&x)[3]) { return f64::v3(x[0], x[1], x[2]); };
    f64::vec3 a = vector(c.a), b = vector(c.b), d = vector(c.c);
    if (c.kind == emitter_area_tiny_triangle) return 1 / f64::length3(f64::cross3(b, d));
    if (c.kind == emitter_area_disk) return c.extra / f64::length3(f64::cross3(b, d));
    if (c.kind == emitter_area_triangle || c.kind == emitter_area_parallelogram)
        return 1 / f64::length3(f64::cross3(f64::sub3(b, a), f64::sub3(d, a)));
    return c.extra;
}

template<class P>
typename P::Light make_light(const LightCase& c) {
    using Real = typename P::Real;
    typename P::Light l{};
    l.kind = c.kind;
    l.ax = Real(c.a[0]), l.ay = Real(c.a[1]), l.az = Real(c.a[2]);
    l.bx = Real(c.b[0]), l.by = Real(c.b[1]), l.bz = Real(c.b[2]);
    l.cx = Real(c.c[0]), l.cy = Real(c.c[1]), l.cz = Real(c.c[2]);
    l.r = 2, l.g = 3, l.b = Real(0.5);
    l.pmf = Real(c.pmf);
    l.area = Real(c.area);
    l.extra = Real(record_extra(c));
    return l;
}

/// Where a ray meets the emitter; `hit` false where it does not, or where no ray can (points,
/// directions).
struct Meeting {
    bool hit;
    f64::vec3 q;
};

Meeting meet(bool hit, f64::vec3 p, f64::vec3 w, double t) {
    return {hit, f64::add3(p, f64::scale3(w, t))};
}

/// Where a ray meets the plane of a, b and c, in coordinates along b - a and c - a.
struct PlaneMeeting {
    double b1, b2, t;
};

PlaneMeeting trace_plane(const f64::Light& l, f64::vec3 p, f64::vec3 w) {
    f64::vec3 a = light_a(l), e1 = f64::sub3(light_b(l), a), e2 = f64::sub3(light_c(l), a);
    f64::vec3 h = f64::cross3(w, e2), from = f64::sub3(p, a), k = f64::cross3(from, e1);
    double determinant = f64::dot3(e1, h);
    return {f64::dot3(from, h) / determinant, f64::dot3(w, k) / determinant,
            f64::dot3(e2, k) / determinant};
}

Meeting trace_area_triangle(const f64::Light& l, f64::vec3 p, f64::vec3 w) {
    PlaneMeeting m = trace_plane(l, p, w);
    return meet(m.t > 0 && m.b1 >= 0 && m.b2 >= 0 && m.b1 + m.b2 <= 1, p, w, m.t);
}

Meeting trace_area_parallelogram(const f64::Light& l, f64::vec3 p, f64::vec3 w) {
    PlaneMeeting m = trace_plane(l, p, w);
    return meet(m.t > 0 && m.b1 >= 0 && m.b2 >= 0 && m.b1 <= 1 && m.b2 <= 1, p, w, m.t);
}

Meeting trace_area_tiny_triangle(const f64::Light& edges, f64::vec3 p, f64::vec3 w) {
    f64::Light l = edges;
    l.bx += l.ax, l.by += l.ay, l.bz += l.az;
    l.cx += l.ax, l.cy += l.ay, l.cz += l.az;
    return trace_area_triangle(l, p, w);
}

Meeting trace_area_disk(const f64::Light& l, f64::vec3 p, f64::vec3 w) {
    f64::vec3 normal = f64::cross3(light_b(l), light_c(l)), to = f64::sub3(light_a(l), p);
    double t = f64::dot3(to, normal) / f64::dot3(w, normal);
    f64::vec3 off = f64::sub3(f64::scale3(w, t), to);
    return meet(t > 0 && f64::length3(off) <= f64::length3(light_b(l)), p, w, t);
}

Meeting trace_area_sphere(const f64::Light& l, f64::vec3 p, f64::vec3 w) {
    f64::vec3 to = f64::sub3(light_a(l), p);
    double along = f64::dot3(to, w), discriminant = along * along - f64::dot3(to, to) + l.bx * l.bx;
    double near = along - std::sqrt(std::max(discriminant, 0.0)),
           far = along + std::sqrt(std::max(discriminant, 0.0));
    return meet(discriminant > 0 && far > 0, p, w, near > 0 ? near : far);
}

Meeting trace_area_cylinder(const f64::Light& l, f64::vec3 p, f64::vec3 w) {
    f64::vec3 n = f64::normalize3(light_b(l)), from = f64::sub3(p, light_a(l));
    double fn = f64::dot3(from, n), wn = f64::dot3(w, n), a = 1 - wn * wn,
           b = (f64::dot3(from, w) - fn * wn) / a,
           left = b * b - (f64::dot3(from, from) - fn * fn - l.cx * l.cx) / a;
    for (double t : {-b - std::sqrt(left), -b + std::sqrt(left)})
        if (double z = fn + t * wn; t > 0 && z >= 0 && z <= f64::length3(light_b(l)))
            return meet(true, p, w, t);
    return {false, p};
}

Meeting trace_constant(const f64::Light&, f64::vec3 p, f64::vec3) { return {true, p}; }
Meeting trace_point(const f64::Light&, f64::vec3 p, f64::vec3) { return {false, p}; }
Meeting trace_spot(const f64::Light&, f64::vec3 p, f64::vec3) { return {false, p}; }
Meeting trace_projector(const f64::Light&, f64::vec3 p, f64::vec3) { return {false, p}; }
Meeting trace_directional(const f64::Light&, f64::vec3 p, f64::vec3) { return {false, p}; }

// One or more of each kind. A kind without cases_<kind> and trace_<kind> does not compile.
using Cases = std::vector<LightCase>;

Cases cases_area_triangle() {
    double area = std::sqrt(1 + 4 + 16.0) / 2;
    return {{0, {-1, -1, 2}, {-1, 1, 3}, {1, 0, 2}, area, 0, 0.25, {0, 0, 0}},
            {0, {-1, -1, 2}, {-1, 1, 3}, {1, 0, 2}, area, 0, 1, {-0.2, 0.1, 2.2}},
            {0, {-1, -1, 2}, {-1, 1, 3}, {1, 0, 2}, area, 0, 1, {20, 9, -99}}}; // small: by area
}
Cases cases_area_parallelogram() {
    double area = std::sqrt(1 + 4 + 16.0);
    return {{0, {-1, -1, 2}, {-1, 1, 3}, {1, 0, 2}, area, 0, 0.25, {0, 0, 0}},
            {0, {-1, -1, 2}, {-1, 1, 3}, {1, 0, 2}, area, 0, 1, {-0.2, 0.1, 2.2}},
            {0, {-1, -1, 2}, {-1, 1, 3}, {1, 0, 2}, area, 0, 1, {0, 0, 2.4999}}, // in front of it
            {0, {-1, -1, 2}, {-1, 1, 3}, {1, 0, 2}, area, 0, 1, {20, 9, -99}}};  // small: by area
}
Cases cases_area_tiny_triangle() { // edges; no size is too large for it, but for its noise
    double area = std::sqrt(1 + 4 + 16.0) / 2;
    return {{0, {-1, -1, 4}, {0, 2, 1}, {2, 1, 0}, area, 0, 0.25, {0, 0, 0}},
            {0, {-1, -1, 2}, {0, 2, 1}, {2, 1, 0}, area, 0, 1, {20, 9, -99}}};
}
Cases cases_area_disk() {
    return {{0, {0.3, 0.2, 3}, {0.7, 0, 0}, {0, 0.7, 0}, M_PI * 0.49, -1, 0.5, {0, 0, 0}},
            {0, {0.3, 0.2, -0.5}, {0, 0.7, 0}, {0, 0, 0.7}, M_PI * 0.49, 1, 1, {1, 0, 0}}};
}
Cases cases_area_sphere() {
    return {{0, {0, 0, 3}, {1, 0, 0}, {}, 4 * M_PI, 1, 0.5, {0, 0, 0}},        // from outside
            {0, {0, 0.4, 0}, {1, 0, 0}, {}, 4 * M_PI, 1, 1, {0, 0.4, 1.02}},   // from close outside
            {0, {0, 0.4, 100}, {1, 0, 0}, {}, 4 * M_PI, 1, 1, {0, 0, 0}},      // from far outside
            {0, {1, 2, 3}, {2, 0, 0}, {}, 16 * M_PI, -1, 0.5, {1.5, 1, 3.2}}}; // from inside
}
Cases cases_area_cylinder() {
    return {{0, {-1, 0, 0}, {2, 0, 0}, {0.5, 0, 0}, 2 * M_PI, 1, 0.5, {0.3, 0.2, -3}},
            {0, {0, 0.4, -2}, {0, 0, 4}, {1, 0, 0}, 8 * M_PI, -1, 1, {0.2, 0.5, 0.1}}}; // inside
}
Cases cases_constant() { return {{0, {}, {}, {}, 0, 0, 0.5, {1, 2, 3}}}; }
Cases cases_point() { return {{0, {1, 2, 2}, {}, {}, 0, 0, 0.5, {0, 0, 0}}}; }
Cases cases_spot() {
    double end = 0.6, beam = 0.4, slope = 1 / (end - beam), inner = std::cos(beam);
    return {{0, {0, 0, 4}, {0, 0, -1}, {std::cos(end), end, slope}, 0, inner, 0.5, {0.5, 0, 0}}};
}
Cases cases_projector() { // a frame of 4/3 x 2/3
    return {{0, {0, 0, 4}, {0, 0, -1}, {0.75, 0, 0}, 0, 2, 0.5, {0.5, 0.2, 0}}};
}
Cases cases_directional() { return {{0, {}, {0, 0.6, -0.8}, {}, 0, 0, 0.5, {0, 0, 0}}}; }

struct EmitterCase {
    std::string name;
    LightCase light;
    Meeting (*trace)(const f64::Light&, f64::vec3, f64::vec3);
};

std::vector<EmitterCase> emitter_cases() {
    std::vector<EmitterCase> all;
#define ADD_EMITTER(label, ...)                                                                    \
    for (LightCase c : cases_##label()) {                                                          \
        c.kind = emitter_##label;                                                                  \
        all.push_back({#label, c, trace_##label});                                                 \
    }
    EMITTERS_BY_ROW(ADD_EMITTER)
#undef ADD_EMITTER
    return all;
}

template<class P>
typename P::Vec3 receiver(const LightCase& c) {
    return vec<P>(c.p[0], c.p[1], c.p[2]);
}

bool seen(const f32::EmitterSample& s) { return s.inverse_pdf > 0; }

bool is_delta(const LightCase& c) {
    return emitter_places.at(std::size_t(c.kind)) == place_nowhere;
}

/// A grid over the cone about the emitter that holds all samples: cosine against the axis, and
/// azimuth.
struct ConeGrid {
    f64::ShadingFrame frame;
    double lowest; // cosine
    static constexpr int side = 16;

    static std::size_t cell(int row, int column) {
        return std::size_t(row) * side + std::size_t(column);
    }

    ConeGrid(const f32::Light& l, f32::vec3 p, Random& random) {
        f64::vec3 sum = {0, 0, 0};
        std::vector<f64::vec3> pilot;
        for (int n = 0; n < 4096; n++)
            if (auto s = emitter_sample(l, p, random.square<F32>()); seen(s)) {
                pilot.push_back(wide(s.wi));
                sum = f64::add3(sum, pilot.back());
            }
        frame = f64::frame_from_normal(f64::normalize3(sum));
        lowest = 1;
        for (f64::vec3 w : pilot)
            lowest = std::min(lowest, f64::dot3(w, frame.n));
        lowest = std::max(-1.0, 1 - (1 - lowest) * 1.2);
    }
    /// side * side for a direction outside the cone.
    std::size_t find(f64::vec3 w) const {
        f64::vec3 v = to_local(frame, w);
        double x = (v.x * v.x + v.y * v.y) / (1 + v.z) / (1 - lowest),
               y = std::atan2(v.y, v.x) / (2 * M_PI) + 0.5;
        if (v.z < 0) x = (1 - v.z) / (1 - lowest);
        if (x >= 1) return side * side;
        return cell(int(x * side), std::min(int(y * side), side - 1));
    }
    f64::vec3 direction(double x, double y) const {
        double drop = x * (1 - lowest), r = std::sqrt(drop * (2 - drop)),
               phi = (y - 0.5) * 2 * M_PI;
        return to_world(frame, f64::v3(r * std::cos(phi), r * std::sin(phi), 1 - drop));
    }
    double solid_angle() const { return 2 * M_PI * (1 - lowest); }
};

} // namespace

TEST_CASE("Emitters: samples follow the density that a traced ray is told", "[emitter]") {
    std::vector<EmitterCase> cases = emitter_cases();
    double level = sidak_level(0.01, cases.size());
    int tested = 0;
    for (const EmitterCase& c : cases) {
        Random random(81);
        f32::Light l = make_light<F32>(c.light);
        f64::Light l64 = make_light<F64>(c.light);
        f32::vec3 p = receiver<F32>(c.light);
        f64::vec3 p64 = receiver<F64>(c.light);
        if (!seen(emitter_sample(l, p, {0.4f, 0.3f}))) continue;
        ConeGrid grid(l, p, random);
        const int cells = ConeGrid::side * ConeGrid::side, fine = 48, count = 400000;
        std::vector<double> observed(cells + 1), expected(cells + 1);
        for (int n = 0; n < count; n++) {
            auto s = emitter_sample(l, p, random.square<F32>());
            observed[seen(s) ? grid.find(wide(s.wi)) : cells]++;
        }
        // The density, traced: midpoints suffice, since only cells cut by the emitter's border are
        // rough.
        double weight = grid.solid_angle() / (ConeGrid::side * ConeGrid::side * fine * fine),
               total = 0;
        for (int i = 0; i < ConeGrid::side * fine; i++)
            for (int j = 0; j < ConeGrid::side * fine; j++) {
                double x = (i + 0.5) / (ConeGrid::side * fine),
                       y = (j + 0.5) / (ConeGrid::side * fine);
                f64::vec3 w = grid.direction(x, y);
                Meeting m = c.trace(l64, p64, w);
                if (!m.hit) continue;
                double density = emitter_hit(l64, p64, w, m.q, true).pdf / c.light.pmf * weight;
                expected[ConeGrid::cell(i / fine, j / fine)] += density * count;
                total += density;
            }
        INFO(c.name << ", pmf " << c.light.pmf << ": density integrates to " << total);
        double scattered = 1 - observed[cells] / count;
        CHECK(total == Approx(scattered).epsilon(2e-3));
        expected[cells] = observed[cells]; // the total is judged above
        for (int i = 0; i < cells; i++)
            expected[std::size_t(i)] *= scattered / total;
        CHECK(chi_square_p(observed, expected) > level);
        tested++;
    }
    CHECK(tested >= 9);
}

TEST_CASE("Emitters: what sample says, a ray that hits finds again", "[emitter]") {
    for (const EmitterCase& c : emitter_cases()) {
        Random random(82);
        f32::Light l = make_light<F32>(c.light);
        f32::vec3 p = receiver<F32>(c.light);
        Worst density, weight, unit;
        for (int n = 0; n < 20000; n++) {
            auto s = emitter_sample(l, p, random.square<F32>());
            unit.add(std::fabs(f64::length3(wide(s.wi)) - 1));
            auto hit = emitter_hit(l, p, s.wi, s.q, true);
            if (is_delta(c.light)) { // no ray meets it
                CHECK(
                    (s.inverse_pdf == 0 && hit.pdf == 0 && f32::max_component(hit.radiance) == 0));
                continue;
            }
            bool bright = f32::max_component(hit.radiance) > 0;
            if (!seen(s)) {
                CHECK(f32::max_component(s.weight) == 0);
                continue;
            }
            if (!bright) FAIL(c.name << ": sampled, but dark to a ray");
            density.add(std::fabs(double(hit.pdf) * s.inverse_pdf - 1));
            for (int k = 0; k < 3; k++)
                weight.add(std::fabs(
                    component(s.weight, k) / s.inverse_pdf / component(hit.radiance, k) - 1));
        }
        INFO(c.name << " at " << c.light.p[0] << ", " << c.light.p[1] << ", " << c.light.p[2]);
        CHECK(unit.value() <= 3e-7);
        CHECK(weight.value() <= 1e-6);
        CHECK(density.value() <= 1e-4);
    }
}

TEST_CASE("Emitters: the dark side gives nothing", "[emitter]") {
    Random random(83);
    LightCase triangle = cases_area_triangle()[0], disk = cases_area_disk()[0],
              sphere = cases_area_sphere()[0];
    triangle.kind = emitter_area_triangle, disk.kind = emitter_area_disk,
    sphere.kind = emitter_area_sphere;
    triangle.p[2] = disk.p[2] = 9;
    sphere.p[2] = 3.2; // inside a sphere that shines outward
    for (const LightCase& c : {triangle, disk, sphere})
        for (int n = 0; n < 1000; n++) {
            auto s = emitter_sample(make_light<F32>(c), receiver<F32>(c), random.square<F32>());
            CHECK(f32::max_component(s.weight) == 0);
            auto hit = emitter_hit(make_light<F32>(c), receiver<F32>(c), s.wi, s.q, true);
            if (seen(s)) CHECK(f32::max_component(hit.radiance) == 0);
        }
}

namespace {

/// Irradiance at the receiver on a surface with this normal, by one light of radiance 2 (red), and
/// its standard error.
Mean irradiance(const LightCase& c, f64::vec3 normal) {
    Random random(84);
    Mean mean;
    f32::Light l = make_light<F32>(c);
    for (int n = 0; n < 400000; n++) {
        auto s = emitter_sample(l, receiver<F32>(c), random.square<F32>());
        mean.add(c.pmf * s.weight.x * std::max(0.0, f64::dot3(wide(s.wi), normal)));
    }
    return mean;
}

void check_irradiance(const Mean& mean, double truth) {
    CHECK(std::fabs(mean.mean() - truth) <= 4 * mean.error() + 1e-6 * truth);
    CHECK(mean.error() < 0.01 * truth);
}

} // namespace

TEST_CASE("Emitters: irradiance is that of the closed forms", "[emitter]") {
    f64::vec3 up = {0, 0, 1};
    const double radiance = 2;
    LightCase disk = {emitter_area_disk, {0, 0, 2}, {1.5, 0, 0}, {0, 1.5, 0},
                      M_PI * 2.25,       -1,        0.5,         {0, 0, 0}};
    check_irradiance(irradiance(disk, up), M_PI * radiance * 2.25 / (2.25 + 4));
    LightCase sphere = {emitter_area_sphere, {1, 0, 3}, {0.8, 0, 0}, {},
                        4 * M_PI * 0.64,     1,         0.5,         {0, 0, 0}};
    check_irradiance(irradiance(sphere, up), M_PI * radiance * 0.64 / 10 * 3 / std::sqrt(10.0));
    LightCase shell = {emitter_area_sphere, {0, 0, 0}, {2, 0, 0}, {},
                       16 * M_PI,           -1,        0.5,       {0.5, -1, 0.2}};
    check_irradiance(irradiance(shell, up), M_PI * radiance);
    LightCase sky = {emitter_constant, {}, {}, {}, 0, 0, 0.5, {}};
    check_irradiance(irradiance(sky, up), M_PI * radiance);
    // A rectangle 1.5 x 2 at height 1 with a corner above the receiver, as two triangles that face
    // down.
    LightCase first = {
        emitter_area_triangle, {0, 0, 1}, {0, 2, 1}, {1.5, 2, 1}, 1.5, 0, 0.5, {0, 0, 0}};
    LightCase second = {
        emitter_area_triangle, {0, 0, 1}, {1.5, 2, 1}, {1.5, 0, 1}, 1.5, 0, 0.5, {0, 0, 0}};
    const double truth = M_PI * radiance * 0.194980345804875;
    Mean a = irradiance(first, up), b = irradiance(second, up);
    CHECK(std::fabs(a.mean() + b.mean() - truth) <= 4 * (a.error() + b.error()));
    LightCase whole = {
        emitter_area_parallelogram, {0, 0, 1}, {0, 2, 1}, {1.5, 0, 1}, 3, 0, 0.5, {0, 0, 0}};
    check_irradiance(irradiance(whole, up), truth);
}

TEST_CASE("Emitters: points, spots and parallel light give their irradiance without noise",
          "[emitter]") {
    LightCase point = cases_point()[0], sun = cases_directional()[0], spot = cases_spot()[0];
    point.kind = emitter_point, sun.kind = emitter_directional, spot.kind = emitter_spot;
    auto red = [](const LightCase& c) {
        auto s = emitter_sample(make_light<F32>(c), receiver<F32>(c), {0.3f, 0.6f});
        CHECK(s.inverse_pdf == 0);
        return double(s.weight.x) * c.pmf;
    };
    CHECK(red(point) == Approx(2 / 9.0));
    CHECK(red(sun) == Approx(2));
    auto s = emitter_sample(make_light<F32>(sun), receiver<F32>(sun), {0, 0});
    CHECK((s.wi.x == 0 && s.wi.y == -0.6f && s.wi.z == 0.8f && s.distant));
    CHECK_FALSE(emitter_sample(make_light<F32>(point), receiver<F32>(point), {0, 0}).distant);
    // Full within 0.4 rad of the axis, nothing from 0.6 on, linear in the angle between.
    for (double angle : {0.0, 0.2, 0.39, 0.45, 0.5, 0.59, 0.61, 1.0, 2.0, 3.1}) {
        double distance = 3, falloff = std::min(1.0, std::max(0.0, (0.6 - angle) / 0.2));
        spot.p[0] = distance * std::sin(angle), spot.p[2] = 4 - distance * std::cos(angle);
        CHECK(red(spot) == Approx(2 * falloff / 9).epsilon(1e-5).margin(1e-7));
    }
}

TEST_CASE("Emitters: the cone of a sphere is right from its surface to a million radii away",
          "[emitter]") {
    Worst solid_angle, next_to_it, on_sphere, direction;
    Random random(85);
    for (int n = 0; n < 100000; n++) {
        LightCase c = cases_area_sphere()[0];
        c.kind = emitter_area_sphere;
        f64::vec3 w = random.direction<F64>();
        double gap = random.log_between(1e-5, 1e6), distance = 1 + gap;
        c.a[0] = w.x * distance, c.a[1] = w.y * distance, c.a[2] = w.z * distance;
        f32::Light l = make_light<F32>(c);
        // The same numbers in both precisions: what is left is the formulas' own rounding.
        f64::Light exact = make_light<F64>(c);
        exact.ax = l.ax, exact.ay = l.ay, exact.az = l.az;
        f32::vec2 u = random.square<F32>();
        auto s = emitter_sample(l, receiver<F32>(c), u);
        auto truth = emitter_sample(exact, receiver<F64>(c), f64::v2(u.x, u.y));
        double off = std::fabs(s.inverse_pdf / truth.inverse_pdf - 1);
        (gap < 1e-3 ? next_to_it : solid_angle).add(off);
        on_sphere.add(std::fabs(f64::length3(f64::sub3(wide(s.q), light_a(exact))) - 1) / distance);
        direction.add(f64::length3(f64::sub3(wide(s.wi), truth.wi)) / (1 + 1 / gap));
    }
    CHECK(solid_angle.value() < 1e-5);
    CHECK(next_to_it.value() < 2e-5); // the cone's cosine is a few ulp over the root of the gap
    CHECK(on_sphere.value() < 1e-6);
    CHECK(direction.value() < 1e-6);
}

TEST_CASE("Emitters: at the ends of the unit interval samples are finite", "[emitter]") {
    const float ends[] = {0, 0.5f, 1 - 0x1p-24f};
    for (const EmitterCase& c : emitter_cases())
        for (float u : ends)
            for (float v : ends) {
                auto s = emitter_sample(make_light<F32>(c.light), receiver<F32>(c.light), {u, v});
                INFO(c.name << " at " << u << ", " << v);
                CHECK(f32::finite3(s.wi));
                CHECK(f32::finite3(s.weight));
                CHECK(f32::finite3(s.q));
                CHECK(std::isfinite(s.inverse_pdf));
                CHECK((seen(s) || is_delta(c.light) || f32::max_component(s.weight) == 0));
            }
}
