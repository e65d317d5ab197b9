// Adaptive integration over a rectangle, in double.
#pragma once

#include <array>
#include <cmath>

namespace parhelion::numerics {

struct Rectangle {
    double x0, x1, y0, y1;
};

/// 7-point Gauss-Legendre product rule.
template<class F>
double gauss_product(const F& f, const Rectangle& r) {
    static constexpr std::array<double, 7> node = {
        -0.94910791234275852, -0.74153118559939444, -0.40584515137739717, 0,
        0.40584515137739717,  0.74153118559939444,  0.94910791234275852};
    static constexpr std::array<double, 7> weight = {
        0.12948496616886969, 0.27970539148927667, 0.38183005050511894, 0.41795918367346939,
        0.38183005050511894, 0.27970539148927667, 0.12948496616886969};
    double half_x = (r.x1 - r.x0) / 2, half_y = (r.y1 - r.y0) / 2;
    double middle_x = (r.x1 + r.x0) / 2, middle_y = (r.y1 + r.y0) / 2, sum = 0;
    for (std::size_t i = 0; i < 7; i++)
        for (std::size_t j = 0; j < 7; j++)
            sum +=
                weight[i] * weight[j] * f(middle_x + half_x * node[i], middle_y + half_y * node[j]);
    return sum * half_x * half_y;
}

/// Integral of f over r: rectangles are quartered until the product rule and its four quarters
/// agree within `tolerance` (absolute) or `depth` runs out. Agreement may be chance: above the
/// depth `certain` it is not enough.
template<class F>
double integrate(const F& f, const Rectangle& r, double tolerance, int depth, int certain,
                 double whole) {
    double mx = (r.x0 + r.x1) / 2, my = (r.y0 + r.y1) / 2;
    const std::array<Rectangle, 4> quarters = {
        Rectangle{r.x0, mx, r.y0, my}, Rectangle{mx, r.x1, r.y0, my}, Rectangle{r.x0, mx, my, r.y1},
        Rectangle{mx, r.x1, my, r.y1}};
    std::array<double, 4> parts;
    double sum = 0;
    for (std::size_t k = 0; k < 4; k++)
        sum += parts[k] = gauss_product(f, quarters[k]);
    if ((std::fabs(sum - whole) <= tolerance && depth <= certain) || depth == 0) return sum;
    sum = 0;
    for (std::size_t k = 0; k < 4; k++)
        sum += integrate(f, quarters[k], tolerance, depth - 1, certain, parts[k]);
    return sum;
}

template<class F>
double integrate(const F& f, const Rectangle& r, double tolerance, int depth = 9, int certain = 9) {
    return integrate(f, r, tolerance, depth, certain, gauss_product(f, r));
}

} // namespace parhelion::numerics
