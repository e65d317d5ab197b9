// Vectors, frames, arc tangents.
#include "host/catalogue/functions.h"

#include <algorithm>

namespace parhelion::stress {
namespace {

using Long = long double;

void put3(float* words, f32::vec3 v) { words[0] = v.x, words[1] = v.y, words[2] = v.z; }

Long dot(const float* a, const float* b) {
    return Long(a[0]) * b[0] + Long(a[1]) * b[1] + Long(a[2]) * b[2];
}
Long length(const float* a) { return sqrtl(dot(a, a)); }

/// Any size from 1e-15 to 1e15, so that no square leaves the range of a float.
f32::vec3 draw_vector(Random& random) {
    return f32::scale3(random.direction<F32>(),
                       static_cast<float>(random.log_between(1e-15, 1e15)));
}

/// Nearly parallel to `v` every second time.
f32::vec3 draw_other(Random& random, f32::vec3 v) {
    if (random.bits() % 2) return draw_vector(random);
    auto nudge = static_cast<float>(random.log_between(1e-7, 1));
    return f32::add3(v, f32::scale3(random.direction<F32>(), f32::length3(v) * nudge));
}

/// Half of them near the poles of the basis.
f32::vec3 draw_normal(Random& random) {
    f32::vec3 n = random.direction<F32>();
    if (random.bits() % 2) {
        auto off = static_cast<float>(random.log_between(1e-20, 1));
        n = f32::normalize3(f32::v3(n.x * off, n.y * off, static_cast<float>(random.sign())));
    }
    return n;
}

FunctionTest cross() {
    return {.group = "maths",
            .probe = "cross3",
            .measures = {{"components", "ulp", 1.5}},
            .draw =
                [](Random& random, float* words) {
                    f32::vec3 a = draw_vector(random);
                    put3(words, a);
                    put3(words + 3, draw_other(random, a));
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    errors[0] = 0;
                    for (int k = 0; k < 3; k++) {
                        int i = (k + 1) % 3, j = (k + 2) % 3;
                        __float128 truth = static_cast<__float128>(in[i]) * in[3 + j] -
                                           static_cast<__float128>(in[j]) * in[3 + i];
                        // Where a product's rounding error is denormal it cannot be carried.
                        Long product = fabsl(Long(in[i]) * in[3 + j]);
                        if (product > 1e-30L && product < 1e36L)
                            errors[0] = std::max(errors[0], ulps(out[k], static_cast<Long>(truth)));
                    }
                }};
}

FunctionTest vectors() {
    return {.group = "maths",
            .probe = "vectors",
            .measures = {{"normalize3, length off 1", "ulp of 1", 3},
                         {"normalize3, direction", "ulp of 1", 3},
                         {"length3", "ulp", 3}},
            .draw =
                [](Random& random, float* words) {
                    put3(words, draw_vector(random));
                    put3(words + 3, draw_vector(random));
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    Long size = length(in), found = length(out), off = 0;
                    for (int k = 0; k < 3; k++)
                        off = std::max(off, fabsl(out[k] - in[k] / size));
                    errors[0] = static_cast<double>(fabsl(found - 1) / 0x1p-23L);
                    errors[1] = static_cast<double>(off / 0x1p-23L);
                    errors[2] = ulps(out[4], length(in + 3));
                }};
}

FunctionTest frame() {
    return {.group = "maths",
            .probe = "frame",
            .measures = {{"largest dot product", "", 2e-7}, {"lengths off 1", "", 4e-7}},
            .draw = [](Random& random, float* words) { put3(words, draw_normal(random)); },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    const float *s = out, *t = out + 3;
                    Long d = std::max({fabsl(dot(s, t)), fabsl(dot(s, in)), fabsl(dot(t, in))});
                    errors[0] = static_cast<double>(d);
                    errors[1] =
                        static_cast<double>(std::max(fabsl(length(s) - 1), fabsl(length(t) - 1)));
                },
            .axis = "log10 of the distance from a pole",
            .axis_low = -8,
            .axis_high = 0,
            .place = [](const float* in) { return std::log10(std::hypot(in[0], in[1])); }};
}

FunctionTest frame_from_tangent() {
    return {.group = "maths",
            .probe = "frame_from_tangent",
            .measures = {{"lengths off 1", "", 6e-7},
                         {"dot products, times the sine to the tangent", "", 4e-7}},
            .draw =
                [](Random& random, float* words) {
                    f32::vec3 n = draw_normal(random);
                    put3(words, n);
                    put3(words + 3, draw_other(random, n));
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    const float *s = out, *t = out + 3, *tangent = in + 3;
                    Long cosine = dot(in, tangent) / length(tangent) / length(in);
                    Long sine = sqrtl(std::max<Long>(0, (1 - cosine) * (1 + cosine)));
                    Long d = std::max({fabsl(dot(s, t)), fabsl(dot(s, in)), fabsl(dot(t, in))});
                    bool usable = sine > 1e-4L;
                    errors[0] = usable ? static_cast<double>(std::max(fabsl(length(s) - 1),
                                                                      fabsl(length(t) - 1) * sine))
                                       : not_asked;
                    errors[1] = usable ? static_cast<double>(d * sine) : not_asked;
                }};
}

FunctionTest arc_tangent() {
    return {.group = "maths",
            .probe = "atan2",
            .measures = {{"absolute", "radians", 3e-7}},
            .draw =
                [](Random& random, float* words) {
                    for (int k = 0; k < 2; k++)
                        words[k] =
                            static_cast<float>(random.sign() * random.log_between(1e-18, 1e18));
                    if (random.bits() % 2)
                        words[1] = static_cast<float>(words[0] * random.sign() *
                                                      random.log_between(0.01, 100));
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    errors[0] = static_cast<double>(fabsl(out[0] - atan2l(in[0], in[1])));
                },
            .axis = "log10 of |y / x|",
            .axis_low = -6,
            .axis_high = 6,
            .place = [](const float* in) { return std::log10(std::fabs(in[0] / in[1])); }};
}

FunctionTest reflection() {
    return {
        .group = "maths",
        .probe = "reflect",
        .measures = {{"length off 1", "ulp of 1", 4}, {"dot with the normal kept", "ulp of 1", 4}},
        .draw =
            [](Random& random, float* words) {
                put3(words, draw_normal(random));
                put3(words + 3, draw_normal(random));
            },
        .judge =
            [](const float* in, const float* out, double* errors) {
                // The lengths of what comes in are theirs; the mirror doubles those of the normal.
                Long n2 = dot(in + 3, in + 3), along = dot(in, in + 3);
                Long off = 0;
                for (int k = 0; k < 3; k++) {
                    Long truth = 2 * along * in[3 + k] - in[k];
                    off = std::max(off, fabsl(out[3 + k] - truth));
                }
                errors[0] = static_cast<double>(off / 0x1p-23L);
                errors[1] = static_cast<double>(fabsl(dot(out + 3, in + 3) - (2 * n2 - 1) * along) /
                                                0x1p-23L);
                if (out[0] != -in[0] || out[1] != -in[1] || out[2] != in[2]) errors[0] = NAN;
            }};
}

} // namespace

std::vector<FunctionTest> vector_functions() {
    return {cross(), vectors(), frame(), frame_from_tangent(), arc_tangent(), reflection()};
}

} // namespace parhelion::stress
