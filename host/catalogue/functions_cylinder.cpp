// Rays against cylinders.
#include "host/catalogue/functions.h"

#include <algorithm>
#include <cmath>

namespace parhelion::stress {
namespace {

using Long = long double;

struct Vector {
    Long x, y, z;
};

Vector at(const float* words) { return {words[0], words[1], words[2]}; }
Long dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

void put3(float* words, f32::vec3 v) { words[0] = v.x, words[1] = v.y, words[2] = v.z; }

/// A ray at a cylinder, from near and far, through its middle or grazing it, across its axis or
/// nearly along it. words: origin relative to the base, direction, axis, radius, height.
void draw_cylinder(Random& random, float* words) {
    double radius = random.log_between(1e-3, 1e3), height = radius * random.log_between(0.1, 1e3),
           distance = radius * (1 + random.log_between(1e-4, 1e4));
    f64::vec3 axis = wide(random.direction<F32>());
    f64::ShadingFrame f = f64::frame_from_normal(f64::normalize3(axis));
    double aside = radius * std::sqrt(random.unit()) * (random.bits() % 2 ? 1 : 0.999999),
           along = height * random.unit(), slope = random.log_between(1e-4, 1e4) * random.sign();
    f64::vec3 origin = to_world(f, f64::v3(distance, 0, along + slope * distance));
    f64::vec3 aim = to_world(f, f64::v3(0, aside, along));
    put3(words, vec_as<F32>(origin));
    put3(words + 3, vec_as<F32>(f64::normalize3(f64::sub3(aim, origin))));
    put3(words + 6, vec_as<F32>(axis));
    words[9] = static_cast<float>(radius);
    words[10] = static_cast<float>(height);
}

/// The first crossing of the wall, by the discriminant in extended precision.
struct Crossing {
    Long chord; ///< half of it across the axis, squared
    Long doubt; ///< of that
    Long t, height, condition;
};

Crossing crossing(const float* in) {
    Vector o = cross(at(in), at(in + 6)), d = cross(at(in + 3), at(in + 6));
    Long r = in[9], a = dot(d, d), b = -dot(o, d), distance = sqrtl(dot(o, o));
    Vector foot = {o.x + d.x * b / a, o.y + d.y * b / a, o.z + d.z * b / a};
    Long aside = dot(foot, foot), chord = r * r - aside;
    Crossing c{chord, 8 * 0x1p-23L * (aside + distance * sqrtl(aside)), 0, 0, 0};
    if (!(chord > 0)) return c;
    c.t = (dot(o, o) - r * r) / (b + sqrtl(chord * a));
    c.height = dot(at(in), at(in + 6)) + c.t * dot(at(in + 3), at(in + 6));
    c.condition = (distance + sqrtl(aside) * distance / sqrtl(chord)) / (c.t * sqrtl(a));
    return c;
}

/// Where both crossings lie well between the ends: there nothing but the circle counts.
bool is_between_ends(const float* in, const Crossing& c) {
    Vector d = at(in + 3), a = at(in + 6), across = cross(d, a);
    Long steps = 2 * sqrtl(c.chord / dot(across, across)), second = c.height + steps * dot(d, a);
    Long low = std::min(c.height, second), high = std::max(c.height, second);
    return low > 0.01L * in[10] && high < 0.99L * in[10];
}

FunctionTest cylinder() {
    return {.group = "surface",
            .probe = "intersect_cylinder",
            .measures = {{"distance, over its condition", "ulp", 16},
                         {"cylinder missed or hit in error", "rays", 0}},
            .draw = draw_cylinder,
            .judge =
                [](const float* in, const float* out, double* errors) {
                    errors[0] = errors[1] = not_asked;
                    Crossing c = crossing(in);
                    if (c.chord < -c.doubt) errors[1] = out[0] != 0;
                    if (!(c.chord > 4 * c.doubt) || !is_between_ends(in, c)) return;
                    errors[1] = out[0] == 0;
                    if (out[0] != 0)
                        errors[0] = ulps(out[1], c.t) / static_cast<double>(1 + c.condition);
                },
            .axis = "log10 of the slope along the axis",
            .axis_low = -4,
            .axis_high = 4,
            .place =
                [](const float* in) {
                    Vector across = cross(at(in + 3), at(in + 6));
                    return static_cast<double>(
                        log10l(fabsl(dot(at(in + 3), at(in + 6))) / sqrtl(dot(across, across))));
                }};
}

} // namespace

std::vector<FunctionTest> cylinder_functions() { return {cylinder()}; }

} // namespace parhelion::stress
