// Gauss-Legendre quadrature on [0, 1].
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace parhelion {

template<std::size_t N>
struct GaussLegendre {
    std::array<double, N> node, weight;

    /// Roots of the Legendre polynomial by Newton's method from their asymptotic places.
    GaussLegendre() {
        for (std::size_t i = 0; i < N; i++) {
            double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (N + 0.5));
            double slope = 0.0;
            for (int step = 0; step < 8; step++) {
                double p = 1.0, before = 0.0; // by the three-term recurrence
                for (std::size_t k = 1; k <= N; k++) {
                    auto n = static_cast<double>(k);
                    double next = ((2.0 * n - 1.0) * x * p - (n - 1.0) * before) / n;
                    before = p;
                    p = next;
                }
                slope = N * (x * p - before) / ((x - 1.0) * (x + 1.0));
                x -= p / slope;
            }
            node[i] = 0.5 * (1.0 + x);
            weight[i] = 1.0 / ((1.0 - x) * (1.0 + x) * slope * slope);
        }
    }

    template<class F>
    double integrate(const F& f) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < N; i++)
            sum += weight[i] * f(node[i]);
        return sum;
    }
};

} // namespace parhelion
