// What the rough coat of a plastic sends back to the base below it.
#include "host/flatten/rough_coat.h"

#include "host/parallel.h"

#include <cmath>
#include <vector>

#include "host/flatten/single_scattering.h" // last: its macros have short names

namespace parhelion {
namespace {

/// The share that is let through of light from everywhere outside, as the device finds it.
double average_let_through(const f64::Material& m, std::span<const float> let_through) {
    constexpr int steps = 4096;
    const f64::EnergyScale scale = f64::energy_scale(m, m.alpha_u);
    double sum = 0.0;
    for (int i = 0; i < steps; i++) {
        double c = (i + 0.5) / steps;
        double place = f64::energy_cosine_coordinate(c, scale) * (ENERGY_COSINES - 1);
        auto at = static_cast<std::size_t>(place);
        double low = let_through[at], high = let_through[at + 1];
        sum += 2.0 * c / steps * (low + (place - static_cast<double>(at)) * (high - low));
    }
    return sum;
}

/// What is reflected inside, as a mean over evenly spaced cosines, both ends among them.
double mean_reflected(const f64::Material& m) {
    constexpr std::size_t cosines = 64;
    const RoughSide inside{m, true, f64::material_interface(m, false), Sent::reflected};
    std::vector<double> reflected(cosines);
    parallel_for(cosines - 1, [&](std::size_t n) { // at grazing angles nothing arrives
        double c = static_cast<double>(n + 1) / (cosines - 1);
        f64::vec3 wo{std::sqrt((1.0 - c) * (1.0 + c)), 0.0, c};
        reflected[n] = 2.0 * c * single_scattering(inside, wo, true);
    });
    double sum = 0.0;
    for (double share : reflected)
        sum += share;
    return sum / cosines;
}

} // namespace

double coat_inner_reflectance(const MaterialRecord& record, std::span<const float> let_through,
                              bool compensated) {
    f64::Material m = widened(record);
    if (compensated) return 1.0 - average_let_through(m, let_through) / (m.er * m.er);
    // The record tells of the interface from outside alone.
    const double eta = m.er;
    m.eg = 1.0 / eta;
    m.kg = -(m.eb + m.kr) * m.eg * m.eg;
    m.kb = 0.0;
    return mean_reflected(m);
}

} // namespace parhelion
