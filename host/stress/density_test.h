// Chi-square tests of materials: do samples follow the density that eval and sample claim?
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/stress/direction_bins.h"
#include "host/stress/materials.h"
#include "host/stress/statistics.h"

namespace parhelion::stress {

/// A material seen from a direction.
struct Configuration {
    MaterialCase material;
    f32::vec3 wo;
};

/// Views of every material of that kind, of those whose lobes are all delta or of the others.
inline std::vector<Configuration> configurations(int kind, bool delta) {
    std::vector<Configuration> list;
    for (const MaterialCase& c : material_cases()) {
        if (c.kind != kind) continue;
        for (f32::vec3 wo : viewer_directions(c))
            if (is_delta<F32>(make_material<F32>(c), wo) == delta) list.push_back({c, wo});
    }
    return list;
}

struct DensityTest {
    double p_value;   ///< chi-square over directions
    double p_missing; ///< that as many samples have a finite density as its integral says
    double integral;  ///< of the density
};

/// Samples against the density of eval, integrated over cells in double. Delta lobes and absorbed
/// samples are counted as "elsewhere". ridge_error: what the quadrature may be off by for grazing
/// views.
inline DensityTest test_density(const Configuration& c, std::uint64_t count, std::uint64_t seed,
                                double ridge_error = 1e-5) {
    auto m = make_material<F32>(c.material);
    auto m64 = make_material<F64>(c.material);
    Random random(seed);
    auto draw = [&] {
        return bsdf_sample(m, c.wo, random.square<F32>(), static_cast<float>(random.unit()));
    };
    auto counts = [](const f32::BsdfSample& s) { return s.pdf > 0 && std::isfinite(s.pdf); };
    std::vector<f32::vec3> pilot;
    for (int n = 0; n < 16384; n++)
        if (f32::BsdfSample s = draw(); counts(s)) pilot.push_back(s.wi);
    DirectionBins bins(pilot, 64);
    std::vector<double> observed(bins.size() + 1), expected(bins.size() + 1);
    for (std::uint64_t n = 0; n < count; n++) {
        f32::BsdfSample s = draw();
        observed[counts(s) ? bins.find(s.wi) : bins.size()]++;
    }
    auto tries = static_cast<double>(count);
    double scattered = 0;
    auto density = [&](f64::vec3 wi) { return bsdf_eval(m64, wide(c.wo), wi).pdf; };
    // Opposite grazing directions have half vectors that turn within a ridge as narrow as the
    // viewer's height; the corner where transmission begins is 2e-4 of a cell, which many samples
    // notice.
    bool grazing = std::fabs(c.wo.z) < 0.05;
    int certain = grazing ? 6 : tries < 1e7 ? 9 : 7;
    for (std::size_t i = 0; i < bins.size(); i++) {
        double mass = bins.mass(i, density, std::max(0.1 / tries, 1e-9), certain);
        expected[i] = tries * mass;
        scattered += mass;
    }
    expected[bins.size()] = tries * std::max(0.0, 1 - scattered);
    double missing = observed[bins.size()] / tries;
    // Normal approximation of the binomial, and the quadrature's own error.
    double sigma = std::sqrt(std::max(missing, 1 / tries) / tries) + (grazing ? ridge_error : 1e-5);
    return {chi_square_p(observed, expected), normal_two_sided((missing - (1 - scattered)) / sigma),
            scattered};
}

} // namespace parhelion::stress
