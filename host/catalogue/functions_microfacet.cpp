// Microfacet distributions, masking, visible normals.
#include "host/catalogue/functions.h"

#include <algorithm>

namespace parhelion::stress {
namespace {

using Long = long double;
constexpr Long pi = 3.14159265358979323846264338327950288L;

/// A direction whose slope is `slope`, at any azimuth; its cosine is 1e-7 at least.
void put_direction(Random& random, double slope, float* words) {
    double z = std::max(1 / std::sqrt(1 + slope * slope), 1e-7), r = std::sqrt((1 - z) * (1 + z)),
           phi = random.between(0, 2 * M_PI);
    words[0] = static_cast<float>(r * std::cos(phi));
    words[1] = static_cast<float>(r * std::sin(phi));
    words[2] = static_cast<float>(z);
}

/// Roughness from 1e-4 to 1, every second one anisotropic; a normal in the middle of the lobe, in
/// its tails, or anywhere to a cosine of 1e-7.
void draw_normal(Random& random, float* words) {
    double au = random.log_between(1e-4, 1),
           av = random.bits() % 2 ? au : random.log_between(1e-4, 1);
    double reach = random.bits() % 2 ? au : av;
    double slope =
        random.bits() % 2 ? reach * random.log_between(1e-2, 1e2) : random.log_between(1e-4, 1e7);
    put_direction(random, slope, words);
    words[3] = static_cast<float>(au), words[4] = static_cast<float>(av);
}

/// (h.x / au)^2 + (h.y / av)^2
Long stretched_square(const float* h, const float* alpha) {
    Long x = Long(h[0]) / alpha[0], y = Long(h[1]) / alpha[1];
    return x * x + y * y;
}

Long ggx_density(const float* h, const float* alpha) {
    Long z = h[2], q = stretched_square(h, alpha) + z * z;
    return 1 / (pi * Long(alpha[0]) * alpha[1] * q * q);
}

/// The exponent of Beckmann's density of a normal, and the density.
Long beckmann_exponent(const float* h, const float* alpha) {
    return stretched_square(h, alpha) / (Long(h[2]) * h[2]);
}
Long beckmann_density(const float* h, const float* alpha) {
    Long z2 = Long(h[2]) * h[2];
    return expl(-beckmann_exponent(h, alpha)) / (pi * Long(alpha[0]) * alpha[1] * z2 * z2);
}

/// Walter's rational form of Beckmann's masking, a: one over the slope.
Long walter_masking(Long a) {
    return a < 1.6L ? a * (3.535L + 2.181L * a) / (1 + a * (2.276L + 2.577L * a)) : 1;
}

/// The length of a direction off 1, and whether it is not above the horizon.
void judge_direction(const float* w, double* errors) {
    Long x = w[0], y = w[1], z = w[2];
    errors[0] = static_cast<double>(fabsl(sqrtl(x * x + y * y + z * z) - 1) / 0x1p-23L);
    errors[1] = !(z > 0);
}

Long stretched_length(const float* w, const float* alpha) {
    Long x = Long(w[0]) * alpha[0], y = Long(w[1]) * alpha[1], z = w[2];
    return sqrtl(x * x + y * y + z * z);
}

double log10_alpha(const float* in) { return std::log10(static_cast<double>(in[3])); }

FunctionTest ggx() {
    return {
        .group = "maths",
        .probe = "ggx",
        .measures = {{"density D", "ulp", 8}, {"masking G1", "ulp", 8}, {"visible D", "ulp", 16}},
        .draw =
            [](Random& random, float* words) {
                draw_normal(random, words);
                put_direction(random, random.log_between(1e-4, 1e7), words + 5);
            },
        .judge =
            [](const float* in, const float* out, double* errors) {
                const float *alpha = in + 3, *h = in + 5;
                Long d = ggx_density(in, alpha);
                // Beyond 1e38 a density is no float: alpha 1e-4 reaches 3e7, a normal at 1e-7 of it
                // 1e-30.
                errors[0] = ulps(out[0], d);
                errors[1] = ulps(out[1], 2 * in[2] / (in[2] + stretched_length(in, alpha)));
                errors[2] =
                    ulps(out[2], 2 * ggx_density(h, alpha) / (in[2] + stretched_length(in, alpha)));
            },
        .axis = "log10 of the roughness",
        .axis_low = -4,
        .axis_high = 0,
        .place = log10_alpha};
}

/// The exponential turns the rounding of its argument t, t ulp, into an error of its own; what is
/// asked is the rest.
FunctionTest beckmann() {
    return {.group = "maths",
            .probe = "beckmann",
            .measures = {{"density D, over 1 + exponent", "ulp", 8},
                         {"masking G1, of Walter's rational form", "ulp", 16}},
            .draw = draw_normal,
            .judge =
                [](const float* in, const float* out, double* errors) {
                    const float* alpha = in + 3;
                    Long t = beckmann_exponent(in, alpha), d = beckmann_density(in, alpha);
                    errors[0] = t < 80 ? ulps(out[0], d) / static_cast<double>(1 + t) : not_asked;
                    Long x = Long(alpha[0]) * in[0], y = Long(alpha[1]) * in[1];
                    Long a = in[2] / sqrtl(x * x + y * y);
                    errors[1] =
                        fabsl(a - 1.6L) < 1e-5L ? not_asked : ulps(out[1], walter_masking(a));
                },
            .axis = "log10 of the roughness",
            .axis_low = -4,
            .axis_high = 0,
            .place = log10_alpha};
}

FunctionTest visible_normals() {
    return {.group = "maths",
            .probe = "ggx_sample_visible",
            .measures = {{"length off 1", "ulp of 1", 4},
                         {"below the horizon or not finite", "inputs", 0}},
            .draw =
                [](Random& random, float* words) {
                    draw_normal(random, words);
                    for (int k = 5; k < 7; k++)
                        words[k] = static_cast<float>(random.bits() % 16  ? random.unit()
                                                      : random.bits() % 2 ? 0
                                                                          : 1 - 0x1p-24);
                },
            .judge = [](const float* /*in*/, const float* out,
                        double* errors) { judge_direction(out, errors); },
            .axis = "log10 of the roughness",
            .axis_low = -4,
            .axis_high = 0,
            .place = log10_alpha};
}

/// c erfc(-x) + s exp(-x^2) / sqrt(pi): of the slopes that a view of the cosine c and the sine s
/// sees, those below x.
Long slopes_below(Long x, Long c, Long s) { return c * erfcl(-x) + s * expl(-x * x) / sqrtl(pi); }

/// How far the shares below the slopes of the normal `h` are from 1 - u, along the view and across
/// it: the mapping is the inverse of the distribution.
Long off_shares(const float* in, const float* h) {
    Long x = Long(in[3]) * in[0], y = Long(in[4]) * in[1], r = hypotl(x, y),
         length = hypotl(r, in[2]);
    Long c = in[2] / length, s = r / length;
    Long cosine = r > 0 ? x / r : 1, sine = r > 0 ? y / r : 0;
    Long slope_x = -Long(h[0]) / in[3] / h[2], slope_y = -Long(h[1]) / in[4] / h[2];
    Long along = slope_x * cosine + slope_y * sine, across = slope_y * cosine - slope_x * sine;
    Long edge = s > 0 ? c / s : 1e3L;
    Long share = along < edge ? slopes_below(along, c, s) / slopes_below(edge, c, s) : 1;
    return fmaxl(fabsl(share - (1 - Long(in[5]))), fabsl(erfcl(-across) / 2 - (1 - Long(in[6]))));
}

FunctionTest visible_normals_of_beckmann() {
    FunctionTest test = visible_normals();
    test.probe = "beckmann_sample_visible";
    test.measures.push_back({"share of normals below it", "", 1e-6});
    test.measures.push_back({"density over 1 + exponent", "ulp", 16});
    test.measures.push_back({"masking over exact masking", "ulp", 16});
    test.judge = [](const float* in, const float* out, double* errors) {
        judge_direction(out, errors);
        errors[2] = static_cast<double>(off_shares(in, out));
        Long sx = Long(in[3]) * in[0], sy = Long(in[4]) * in[1], r = hypotl(sx, sy), a = in[2] / r;
        Long whole = r > 0 ? slopes_below(a, in[2], r) : 2 * Long(in[2]);
        Long t = beckmann_exponent(out, in + 3), d = beckmann_density(out, in + 3);
        errors[3] = t < 80 ? ulps(out[3], 2 * d / whole) / static_cast<double>(1 + t) : not_asked;
        Long ratio = walter_masking(a) * whole / (2 * in[2]);
        errors[4] = fabsl(a - 1.6L) < 1e-5L ? not_asked : ulps(out[4], ratio);
    };
    return test;
}

FunctionTest heuristic() {
    return {.group = "maths",
            .probe = "power_heuristic",
            .measures = {{"from p1^2 / (p1^2 + p2^2)", "ulp", 5},
                         {"both weights, off 1", "ulp of 1", 2},
                         {"no number", "inputs", 0}},
            .draw =
                [](Random& random, float* words) {
                    for (int k = 0; k < 2; k++) {
                        words[k] = static_cast<float>(random.log_between(1e-38, 3e38));
                        if (random.bits() % 32 == 0) words[k] = INFINITY;
                    }
                    if (random.bits() % 4 == 0)
                        words[1] = static_cast<float>(words[0] * random.log_between(1e-4, 1e4));
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    bool both = std::isinf(in[0]) && std::isinf(in[1]);
                    errors[1] =
                        both ? not_asked : std::fabs(double(out[0]) + double(out[2]) - 1) / 0x1p-23;
                    errors[2] = std::isnan(out[0]) || std::isnan(out[2]);
                    Long r = Long(in[1]) / Long(in[0]), w = std::isinf(in[0]) ? 1 : 1 / (1 + r * r);
                    // Too small for a float of full precision: nothing of it arrives.
                    errors[0] =
                        both || std::isinf(in[1]) || w < 1e-36L ? not_asked : ulps(out[0], w);
                },
            .axis = "log10 of the ratio",
            .axis_low = -20,
            .axis_high = 20,
            .place = [](const float* in) { return std::log10(double(in[1]) / double(in[0])); }};
}

} // namespace

std::vector<FunctionTest> microfacet_functions() {
    return {ggx(), beckmann(), visible_normals(), visible_normals_of_beckmann(), heuristic()};
}

} // namespace parhelion::stress
