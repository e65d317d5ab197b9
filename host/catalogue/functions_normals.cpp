// Shading normals that keep to the geometry.
#include "host/catalogue/functions.h"

#include <algorithm>

namespace parhelion::stress {
namespace {

using Long = long double;

f32::vec3 read3(const float* words) { return f32::v3(words[0], words[1], words[2]); }
void put3(float* words, f32::vec3 v) { words[0] = v.x, words[1] = v.y, words[2] = v.z; }

Long dot(const float* a, const float* b) {
    return Long(a[0]) * b[0] + Long(a[1]) * b[1] + Long(a[2]) * b[2];
}
/// As the kernels have it: its sign says on which side they see something.
float rounded_dot(const float* a, const float* b) { return f32::dot3(read3(a), read3(b)); }

/// Every second one within 1e-6 to 1 of the plane across n.
f32::vec3 draw_grazing(Random& random, f32::vec3 n) {
    f32::vec3 w = random.direction<F32>();
    if (random.bits() % 2) return w;
    f32::vec3 flat = f32::sub3(w, f32::scale3(n, f32::dot3(w, n)));
    auto height = static_cast<float>(random.sign() * random.log_between(1e-6, 1));
    return f32::normalize3(f32::add3(flat, f32::scale3(n, height)));
}

/// Normals from hardly to very different.
f32::vec3 draw_shading_normal(Random& random, f32::vec3 ng) {
    f32::vec3 n = random.direction<F32>();
    if (random.bits() % 4 == 0) return n;
    auto nudge = static_cast<float>(random.log_between(1e-5, 1));
    return f32::normalize3(f32::add3(ng, f32::scale3(n, nudge)));
}

/// How much lower than a quarter of the viewer's height over the surface its mirror image is.
Long too_low(const float* n, const float* g, const float* wo) {
    Long height = fabsl(dot(g, wo)), side = dot(g, wo) < 0 ? -1 : 1;
    Long image = side * (2 * dot(n, wo) * dot(n, g) / dot(n, n) - dot(g, wo));
    return std::max<Long>(0, height / 4 - image);
}

/// The share of diffuse light, between directions on one side.
Long faded(const float* n, const float* g, const float* wi) {
    Long ratio = std::min<Long>(1, dot(g, wi) / (dot(n, wi) * dot(n, g)));
    return ratio + ratio * ratio - ratio * ratio * ratio;
}

void judge_side(const float* in, const float* out, double* errors) {
    const float *wo = in + 6, *wi = in + 9, *n = out, *g = out + 3, *shares = out + 6;
    float viewer = rounded_dot(g, wo), share = std::max(shares[0], shares[1]);
    bool other_side = rounded_dot(n, wi) * rounded_dot(g, wi) <= 0;
    bool clear = dot(n, wi) * dot(g, wi) > 0 && !other_side;
    errors[0] = viewer != 0 && rounded_dot(n, wo) * std::copysign(1.f, viewer) <= 0;
    errors[1] = static_cast<double>(too_low(n, g, wo));
    errors[2] = static_cast<double>(fabsl(sqrtl(dot(n, n)) - 1) / 0x1p-23L);
    errors[3] = other_side ? share > 0 : !(shares[0] == 1);
    errors[4] = static_cast<double>((std::max(share, 1.f) - 1) / 0x1p-23L);
    errors[5] = clear
                    ? static_cast<double>(
                          fabsl((shares[1] - faded(n, g, wi)) * dot(n, wi) * dot(n, g)) / 0x1p-23L)
                    : not_asked;
}

FunctionTest side() {
    return {.group = "surface",
            .probe = "shading_side",
            .measures = {{"viewers below", "inputs", 0},
                         {"mirror image lower than a quarter of the viewer's height", "", 1e-6},
                         {"length off 1", "ulp of 1", 4},
                         {"light of the other side counts, or its own does not", "inputs", 0},
                         {"shares above 1", "ulp of 1", 1},
                         {"share of diffuse light, times the cosines to light and geometry",
                          "ulp of 1", 4}},
            .draw =
                [](Random& random, float* words) {
                    f32::vec3 ng = random.direction<F32>();
                    put3(words, draw_shading_normal(random, ng));
                    put3(words + 3, ng);
                    put3(words + 6, draw_grazing(random, ng));
                    put3(words + 9, draw_grazing(random, ng));
                },
            .judge = judge_side,
            .axis = "log10 of the viewer's height",
            .axis_low = -6,
            .axis_high = 0,
            .place = [](const float* in) { return std::log10(std::fabs(dot(in + 3, in + 6))); }};
}

} // namespace

std::vector<FunctionTest> normals_functions() { return {side()}; }

} // namespace parhelion::stress
