// Rays against triangles, boxes and spheres, and the solid angle of triangles.
#include "host/catalogue/functions.h"
#include "host/numerics/seen_triangles.h"

#include <algorithm>
#include <array>

namespace parhelion::stress {
namespace {

using Long = long double;
using Exact = __float128;

void put3(float* words, f32::vec3 v) { words[0] = v.x, words[1] = v.y, words[2] = v.z; }

Long dot(const Long* a, const Long* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// ---------------------------------------------------------------------------------------- boxes

/// A box on one axis and a ray that touches or enters it: often flat, far from the origin (1e5),
/// parallel, or started on a plane. words: origin, direction, largest component; low and high of
/// the box in 3 and 4.
void draw_slab(Random& random, float* words) {
    double far = random.bits() % 2 ? random.between(-1, 1) * 1e5 : random.between(-1, 1);
    auto low = static_cast<float>(far);
    auto high = static_cast<float>(far + (random.bits() % 4 ? random.log_between(1e-6, 10) : 0));
    words[0] = static_cast<float>(random.bits() % 8   ? far + random.between(-10, 10)
                                  : random.bits() % 2 ? low
                                                      : high);
    double d = random.sign() * random.log_between(1e-9, 1);
    words[1] = static_cast<float>(random.bits() % 8 ? d : d > 0 ? 0. : -0.);
    words[2] = 1;
    words[3] = low, words[4] = std::max(low, high);
}

/// The interval of distances at which the ray is within the slab, against what the box test takes
/// for it.
FunctionTest slab() {
    return {.group = "surface",
            .probe = "ray_slab",
            .measures = {{"crossings of a box lost", "rays", 0}, {"no number", "rays", 0}},
            .draw = draw_slab,
            .judge =
                [](const float* in, const float* out, double* errors) {
                    float near = std::fma(out[0] < 0 ? in[4] : in[3], out[0], out[1]);
                    float far = std::fma(out[0] < 0 ? in[3] : in[4], out[0], out[2]);
                    errors[0] = not_asked;
                    errors[1] = std::isnan(near) || std::isnan(far);
                    Exact o = in[0], d = in[1], low = in[3], high = in[4];
                    bool enters, leaves;
                    if (in[1] == 0) {
                        enters = leaves = true; // at any distance, where it is inside at all
                        if (o < low || o > high) return;
                        errors[0] = near > 0 || far < 1e6f;
                        return;
                    }
                    Exact a = (low - o) / d, b = (high - o) / d;
                    Exact first = a < b ? a : b, last = a < b ? b : a;
                    if (last < 0) return;
                    Exact entry = near > 0 ? Exact(near) : Exact(0);
                    enters = entry <= (first > 0 ? first : Exact(0)) * Exact(BOX_WIDENING);
                    leaves = Exact(far) * Exact(BOX_WIDENING) >= last;
                    errors[0] = !(enters && leaves);
                },
            .axis = "log10 of the slope",
            .axis_low = -9,
            .axis_high = 0,
            .place = [](const float* in) { return std::log10(std::fabs(in[1])); }};
}

// -------------------------------------------------------------------------------------- spheres

/// A ray at a sphere, from near and far, through its middle or grazing it. words: origin relative
/// to the centre, direction, radius.
void draw_sphere(Random& random, float* words) {
    double radius = random.log_between(1e-3, 1e3),
           distance = radius * (1 + random.log_between(1e-4, 1e4));
    f64::vec3 at = f64::scale3(random.direction<F64>(), distance);
    double aside = radius * std::sqrt(random.unit()) * (random.bits() % 2 ? 1 : 0.999999);
    f64::ShadingFrame f = f64::frame_from_normal(f64::normalize3(at));
    double phi = random.between(0, 2 * M_PI);
    f64::vec3 aim =
        f64::add3(f64::scale3(f.s, aside * std::cos(phi)), f64::scale3(f.t, aside * std::sin(phi)));
    put3(words, vec_as<F32>(at));
    put3(words + 3, vec_as<F32>(f64::normalize3(f64::sub3(aim, at))));
    words[6] = static_cast<float>(radius);
}

/// The distance of the first hit, by the discriminant in extended precision; its error over what a
/// rounding of the inputs can do there, which grows as the ray grazes.
FunctionTest sphere() {
    return {
        .group = "surface",
        .probe = "intersect_sphere",
        .measures = {{"distance, over its condition", "ulp", 16},
                     {"sphere missed or hit in error", "rays", 0}},
        .draw = draw_sphere,
        .judge =
            [](const float* in, const float* out, double* errors) {
                Long o[3] = {in[0], in[1], in[2]}, d[3] = {in[3], in[4], in[5]}, r = in[6];
                Long a = dot(d, d), b = -dot(o, d), c = dot(o, o) - r * r;
                Long foot = 0;
                for (int k = 0; k < 3; k++)
                    foot += (o[k] + d[k] * b / a) * (o[k] + d[k] * b / a);
                Long chord = r * r - foot; // half of it, squared
                Long distance = sqrtl(dot(o, o));
                // The foot is known to a few roundings of the origin.
                Long doubt = 8 * 0x1p-23L * (foot + distance * sqrtl(foot));
                errors[1] =
                    fabsl(chord) > doubt ? (out[0] != 0) != (chord > 0 && b > 0) : not_asked;
                errors[0] = not_asked;
                if (!(chord > 4 * doubt) || out[0] == 0) return;
                Long t = c / (b + sqrtl(chord * a));
                Long condition =
                    (distance + sqrtl(foot) * distance / sqrtl(chord)) / (t * sqrtl(a));
                errors[0] = ulps(out[1], t) / static_cast<double>(1 + condition);
            },
        .axis = "log10 of distance over radius",
        .axis_low = 0,
        .axis_high = 4,
        .place =
            [](const float* in) { return std::log10(std::hypot(in[0], in[1], in[2]) / in[6]); }};
}

// -------------------------------------------------------------------------------------- triangles

/// Woop, Benthin and Wald's test on a ray through the inside of a triangle; words as the probe's:
/// corners, shear, t_max.
void draw_triangle(Random& random, float* words) {
    f32::vec3 centre =
        f32::scale3(random.direction<F32>(), static_cast<float>(random.log_between(1, 1e3)));
    centre.z = std::fabs(centre.z) + 0.5f;
    double size = random.log_between(1e-3, 10);
    for (int k = 0; k < 3; k++)
        put3(words + 3 * k,
             f32::add3(centre, f32::scale3(random.direction<F32>(), static_cast<float>(size))));
    double b1 = random.unit(), b2 = random.unit() * (1 - b1), b0 = 1 - b1 - b2;
    double aim[3];
    for (int k = 0; k < 3; k++)
        aim[k] = b0 * words[k] + b1 * words[3 + k] + b2 * words[6 + k];
    // The probe scales the first two: a ray is at most as steep as its largest axis.
    words[9] = static_cast<float>(aim[0] / aim[2] * 100);
    words[10] = static_cast<float>(aim[1] / aim[2] * 100);
    words[11] = static_cast<float>(1 / aim[2]);
    words[12] = INFINITY;
}

struct TriangleTruth {
    Long t, b1, b2, determinant, scale;
};

TriangleTruth triangle_truth(const float* in) {
    Long sx = in[9] * .01f, sy = in[10] * .01f, sz = in[11];
    Long x[3], y[3];
    for (int k = 0; k < 3; k++) {
        x[k] = in[3 * k] - sx * in[3 * k + 2];
        y[k] = in[3 * k + 1] - sy * in[3 * k + 2];
    }
    Long u = x[2] * y[1] - y[2] * x[1], v = x[0] * y[2] - y[0] * x[2],
         w = x[1] * y[0] - y[1] * x[0];
    Long det = u + v + w, scale = 0;
    for (int k = 0; k < 3; k++)
        scale = std::max({scale, fabsl(x[k]), fabsl(y[k])});
    // Corners are rounded to the coordinates they have before the shear.
    Long rounding = 0;
    for (int k = 0; k < 9; k++)
        rounding = std::max(rounding, fabsl(Long(in[k])));
    return {sz * (u * in[2] + v * in[5] + w * in[8]) / det, v / det, w / det, det,
            scale * rounding / fabsl(det)};
}

FunctionTest triangle() {
    return {.group = "surface",
            .probe = "intersect_triangle",
            .measures = {{"barycentrics, over their condition", "ulp of 1", 8},
                         {"distance, over its condition", "ulp", 16}},
            .draw = draw_triangle,
            .judge =
                [](const float* in, const float* out, double* errors) {
                    errors[0] = errors[1] = not_asked;
                    if (out[0] == 0 || std::fabs(in[9]) > 100 || std::fabs(in[10]) > 100) return;
                    TriangleTruth truth = triangle_truth(in);
                    Long off = std::max(fabsl(out[2] - truth.b1), fabsl(out[3] - truth.b2));
                    errors[0] = static_cast<double>(off / 0x1p-23L / (1 + truth.scale));
                    Long lo = std::min({in[2], in[5], in[8]}), hi = std::max({in[2], in[5], in[8]});
                    Long slope = (hi - lo) * fabsl(Long(in[11])) / fabsl(truth.t);
                    errors[1] =
                        ulps(out[1], truth.t) / static_cast<double>(1 + truth.scale * slope);
                },
            .axis = "log10 of the distance",
            .axis_low = -1,
            .axis_high = 3,
            .place = [](const float* in) { return std::log10(std::fabs(in[2])); }};
}

// ------------------------------------------------------------------------------------ solid angle

Corners corners(const float* words) {
    Corners c;
    for (int k = 0; k < 3; k++)
        c[k] = f32::v3(words[3 * k], words[3 * k + 1], words[3 * k + 2]);
    return c;
}

/// From 1e-10 sr to almost all of the sphere; every fourth next to a side.
void draw_seen_triangle(Random& random, float* words) {
    Corners c = random.bits() % 4 ? triangle_ahead(random, random.log_between(1e-5, 3))
                                  : triangle_beside(random, random.log_between(1e-5, 1));
    for (int k = 0; k < 3; k++)
        put3(words + 3 * k, c[k]);
    words[9] = static_cast<float>(random.unit()), words[10] = static_cast<float>(random.unit());
}

FunctionTest solid_angle() {
    return {
        .group = "surface",
        .probe = "spherical_triangle",
        .measures = {{"solid angle, relative", "", 2e-6},
                     {"solid angle, relative, of triangles seen from aside", "", 2e-5},
                     {"solid angle, relative, from near the plane, over its condition", "", 2e-6},
                     {"directions, length off 1", "", 2e-6},
                     {"directions outside the triangle, of its width", "", 1e-4}},
        .draw = draw_seen_triangle,
        .judge =
            [](const float* in, const float* out, double* errors) {
                for (int k = 0; k < 5; k++)
                    errors[k] = not_asked;
                Corners c = corners(in);
                Long truth = solid_angle_truth(c);
                if (!(truth > 1e-10L && truth < 6)) return;
                double sine = facing(c), off = static_cast<double>(fabsl(out[0] / truth - 1));
                bool faced = sine > 0.5;
                if (height_over_plane(c) > 0.1)
                    errors[faced ? 0 : 1] = off;
                else
                    errors[2] = off * sine * bluntness(c);
                if (truth < SOLID_ANGLE_LEAST) return;
                double x = out[1], y = out[2], z = out[3];
                if (faced) errors[3] = std::fabs(std::sqrt(x * x + y * y + z * z) - 1);
                double b1 = out[4], b2 = out[5];
                errors[4] = std::max({-b1, -b2, b1 + b2 - 1, 0.});
            },
        .axis = "log10 of the solid angle",
        .axis_low = -10,
        .axis_high = 1,
        .place =
            [](const float* in) {
                return std::log10(static_cast<double>(solid_angle_truth(corners(in))));
            },
        .share = 0.5};
}

} // namespace

std::vector<FunctionTest> intersection_functions() {
    return {slab(), sphere(), triangle(), solid_angle()};
}

} // namespace parhelion::stress
