// Fresnel's formulas in extended precision, and inputs that are dense where they are dangerous.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>

#include "host/numerics/measure.h"

namespace parhelion::numerics {

using Long = long double;

/// A relative index: from 1 + 1e-6 to 2.5, every second one the other way round.
inline double random_index(Random& random) {
    double eta = 1 + random.log_between(1e-6, 1.5);
    return random.sign() > 0 ? eta : 1 / eta;
}

/// A cosine: from 1e-7 to 1, a third each logarithmic, uniform, and close to 1.
inline float random_cosine(Random& random) {
    double choice = random.unit();
    double c = choice < 1 / 3.   ? random.log_between(1e-7, 1)
               : choice < 2 / 3. ? random.unit()
                                 : 1 - random.log_between(1e-7, 1);
    return std::max(static_cast<float>(c), 1e-7f);
}

/// Shares of the power that comes in.
struct FresnelTruth {
    Long reflectance, transmittance;
};

/// For the cosine c and the contrast m = eta^2 - 1: Fresnel's amplitudes, differences of nearly
/// equal numbers written as quotients.
inline FresnelTruth dielectric_truth(Long c, Long m) {
    Long eta2 = 1 + m, g2 = m + c * c;
    if (g2 <= 0) return {1, 0};
    Long g = sqrtl(g2), s = m / ((c + g) * (c + g));
    Long p = m * ((eta2 + 1) * c * c - 1) / ((eta2 * c + g) * (eta2 * c + g));
    return {(s * s + p * p) / 2,
            2 * c * g * (1 / ((c + g) * (c + g)) + eta2 / ((eta2 * c + g) * (eta2 * c + g)))};
}

/// Unpolarised reflectance; n: index relative to the side of incidence.
inline Long conductor_truth(Long c, std::complex<Long> n) {
    std::complex<Long> beyond = std::sqrt(n * n - (1 - c) * (1 + c));
    return (std::norm((c - beyond) / (c + beyond)) +
            std::norm((n * n * c - beyond) / (n * n * c + beyond))) /
           2;
}

} // namespace parhelion::numerics
