// Fresnel's formulas and refraction.
#include "host/catalogue/functions.h"

#include "host/numerics/fresnel_truth.h"

namespace parhelion::stress {
namespace {

void put_interface(float* words, const f32::Interface& i) {
    words[0] = i.eta, words[1] = i.inv_eta, words[2] = i.m_high, words[3] = i.m_low;
}

/// eta^2 - 1 of the interface in these words, to 48 bits.
Long contrast(const float* words) { return Long(words[2]) + Long(words[3]); }
Long index(const float* words) { return sqrtl(1 + contrast(words)); }

bool in_unit_interval(float x) { return x >= 0 && x <= 1; }

double log10_of(float x) { return std::log10(static_cast<double>(x)); }

FunctionTest dielectric() {
    return {.group = "maths",
            .probe = "fresnel_dielectric",
            .measures = {{"reflectance", "ulp", 16},
                         {"transmittance", "ulp", 8},
                         {"outside of [0, 1]", "inputs", 0}},
            .draw =
                [](Random& random, float* words) {
                    words[0] = random_cosine(random);
                    put_interface(words + 1, interface_of<F32>(random_index(random)));
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    FresnelTruth truth = dielectric_truth(in[0], contrast(in + 1));
                    // Where less than that is reflected, no float of the path remembers it.
                    errors[0] =
                        truth.reflectance > 1e-30L ? ulps(out[0], truth.reflectance) : not_asked;
                    errors[1] = ulps(out[1], truth.transmittance);
                    errors[2] = !in_unit_interval(out[0]) || !(out[1] >= 0 && out[1] <= 1 + 1e-6f);
                },
            .axis = "log10 of the cosine",
            .axis_low = -7,
            .axis_high = 0,
            .place = [](const float* in) { return log10_of(in[0]); }};
}

FunctionTest critical_angle() {
    return {.group = "maths",
            .probe = "fresnel_dielectric",
            .name = "fresnel_critical_angle",
            .measures = {{"wrong sides within 1e-6", "inputs", 0}, {"reflectance", "ulp", 16}},
            .draw =
                [](Random& random, float* words) {
                    double eta = 1 / (1 + random.log_between(1e-4, 1.5));
                    double critical = std::sqrt((1 - eta) * (1 + eta));
                    words[0] = static_cast<float>(critical * (1 + random.between(-1e-6, 1e-6)));
                    put_interface(words + 1, interface_of<F32>(eta));
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    __float128 m = static_cast<__float128>(in[3]) + in[4];
                    bool transmits = m + static_cast<__float128>(in[0]) * in[0] > 0;
                    errors[0] = (out[2] > 0) != transmits;
                    errors[1] = ulps(out[0], dielectric_truth(in[0], contrast(in + 1)).reflectance);
                },
            .axis = "log10 of 1 - index",
            .axis_low = -4,
            .axis_high = 0,
            .place = [](const float* in) { return log10_of(1 - in[1]); }};
}

FunctionTest no_interface() {
    return {.group = "maths",
            .probe = "refract_local",
            .name = "refract_index_1",
            .measures = {{"directions changed", "inputs", 0}},
            .draw =
                [](Random& random, float* words) {
                    f32::vec3 w = random.direction<F32>();
                    words[0] = w.x, words[1] = w.y, words[2] = w.z;
                    put_interface(words + 3, interface_of<F32>(1));
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    errors[0] = out[0] != -in[0] || out[1] != -in[1] || out[2] != -in[2];
                },
            .share = 0.1};
}

/// What comes in is of unit length only to rounding, which grazing magnifies: the truth is the
/// refraction of this same vector.
FunctionTest refraction() {
    return {.group = "maths",
            .probe = "refract_local",
            .measures = {{"Snell's law", "ulp of 1", 4},
                         {"length", "ulp of 1", 2},
                         {"on the wrong side", "inputs", 0}},
            .draw =
                [](Random& random, float* words) {
                    f32::vec3 w = random.direction<F32>();
                    if (random.bits() % 4 == 0) {
                        w.z *= static_cast<float>(random.log_between(1e-7, 1));
                        w = f32::normalize3(w);
                    }
                    words[0] = w.x, words[1] = w.y, words[2] = w.z;
                    put_interface(words + 3, interface_of<F32>(random_index(random)));
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    Long eta = index(in + 3), g2 = contrast(in + 3) + Long(in[2]) * in[2];
                    bool reflected = out[0] == 0 && out[1] == 0 && out[2] == 0;
                    errors[0] = errors[1] = not_asked;
                    errors[2] = reflected != (g2 <= 0) || (!reflected && in[2] * out[2] > 0);
                    if (reflected || g2 <= 0) return;
                    Long x = -in[0] / eta, y = -in[1] / eta, z = sqrtl(g2) / eta;
                    Long ulp = 0x1p-23L;
                    errors[0] = static_cast<double>(hypotl(out[0] - x, out[1] - y) / ulp);
                    Long found = sqrtl(Long(out[0]) * out[0] + Long(out[1]) * out[1] +
                                       Long(out[2]) * out[2]);
                    errors[1] =
                        static_cast<double>(fabsl(found - sqrtl(x * x + y * y + z * z)) / ulp);
                },
            .axis = "log10 of the cosine",
            .axis_low = -7,
            .axis_high = 0,
            .place = [](const float* in) { return log10_of(std::fabs(in[2])); }};
}

FunctionTest conductor() {
    return {.group = "maths",
            .probe = "fresnel_conductor",
            .measures = {{"reflectance", "ulp", 16}, {"outside of [0, 1]", "inputs", 0}},
            .draw =
                [](Random& random, float* words) {
                    words[0] = random_cosine(random);
                    words[1] = static_cast<float>(random.log_between(0.05, 10));
                    words[2] = static_cast<float>(random.log_between(1e-3, 20));
                    if (random.bits() % 16 == 0) words[2] = 0;
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    errors[1] = !in_unit_interval(out[0]);
                    // An index below 1 with next to no absorption has a critical angle, where float
                    // cosines decide nothing.
                    bool critical = in[1] < 1 && in[2] < 0.1f;
                    errors[0] =
                        critical ? not_asked : ulps(out[0], conductor_truth(in[0], {in[1], in[2]}));
                },
            .axis = "log10 of the cosine",
            .axis_low = -7,
            .axis_high = 0,
            .place = [](const float* in) { return log10_of(in[0]); }};
}

FunctionTest conductor_without_absorption() {
    return {.group = "maths",
            .probe = "fresnel_conductor",
            .name = "fresnel_conductor_as_dielectric",
            .measures = {{"reflectance", "ulp", 16}},
            .draw =
                [](Random& random, float* words) {
                    words[0] = random_cosine(random);
                    words[1] = static_cast<float>(random.between(1.05, 2.5));
                    words[2] = 0;
                },
            .judge =
                [](const float* in, const float* out, double* errors) {
                    Long m = (Long(in[1]) - 1) * (Long(in[1]) + 1);
                    errors[0] = ulps(out[0], dielectric_truth(in[0], m).reflectance);
                },
            .share = 0.1};
}

} // namespace

std::vector<FunctionTest> fresnel_functions() {
    return {dielectric(), critical_angle(), no_interface(),
            refraction(), conductor(),      conductor_without_absorption()};
}

} // namespace parhelion::stress
