// Maps from the unit square, and leaving a surface.
#include "host/catalogue/functions.h"

#include <algorithm>

namespace parhelion::stress {
namespace {

using Long = long double;

/// Uniform on the device's grid; its ends more often than chance would.
void draw_square(Random& random, float* words) {
    for (int k = 0; k < 2; k++)
        words[k] = static_cast<float>(random.bits() % 16  ? random.unit()
                                      : random.bits() % 2 ? 0
                                                          : 1 - 0x1p-24);
}

Long length(const float* v) {
    return sqrtl(Long(v[0]) * v[0] + Long(v[1]) * v[1] + Long(v[2]) * v[2]);
}

FunctionTest hemisphere() {
    return {.group = "maths",
            .probe = "hemisphere_cosine",
            .measures = {{"length off 1", "", 5e-7}, {"not above the horizon", "inputs", 0}},
            .draw = draw_square,
            .judge = [](const float* /*in*/, const float* out, double* errors) {
                errors[0] = static_cast<double>(fabsl(length(out) - 1));
                errors[1] = !(out[2] > 0);
            }};
}

FunctionTest sphere() {
    return {.group = "maths",
            .probe = "sphere_uniform",
            .measures = {{"length off 1", "", 5e-7}},
            .draw = draw_square,
            .judge = [](const float* /*in*/, const float* out, double* errors) {
                errors[0] = static_cast<double>(fabsl(length(out) - 1));
            }};
}

FunctionTest disk() {
    return {.group = "maths",
            .probe = "disk_uniform",
            .measures = {{"position", "", 4e-7}, {"beyond the rim", "", 2e-7}},
            .draw = draw_square,
            .judge = [](const float* in, const float* out, double* errors) {
                double r = std::sqrt(double(in[0])), phi = 2 * M_PI * double(in[1]);
                errors[0] = std::max(std::fabs(out[0] - r * std::cos(phi)),
                                     std::fabs(out[1] - r * std::sin(phi)));
                errors[1] = std::max(0., std::hypot(double(out[0]), double(out[1])) - 1);
            }};
}

FunctionTest triangle() {
    return {.group = "maths",
            .probe = "triangle_uniform",
            .measures = {{"outside the triangle", "inputs", 0}},
            .draw = draw_square,
            .judge = [](const float* /*in*/, const float* out, double* errors) {
                errors[0] = !(out[0] >= 0 && out[1] >= 0 && double(out[0]) + double(out[1]) <= 1);
            }};
}

} // namespace

std::vector<FunctionTest> sampling_functions() {
    return {hemisphere(), sphere(), disk(), triangle()};
}

} // namespace parhelion::stress
