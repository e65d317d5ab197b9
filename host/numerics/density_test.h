// Chi-square tests of materials: do samples follow the density that eval and sample claim?
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/numerics/direction_bins.h"
#include "host/numerics/materials.h"
#include "host/numerics/statistics.h"

namespace parhelion::numerics {

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

/// w anywhere in the cell of directions that round to it: of a lobe a few millionths wide, seen at
/// a grazing angle, the cells of a chi-square test would else end at places to which many round.
inline f64::vec3 unrounded(f32::vec3 w, Random& random) {
    auto shift = [&](float x) {
        double size = std::fabs(x);
        return x + (random.unit() - 0.5) * (std::nextafter(std::fabs(x), 2.f) - size);
    };
    return f64::v3(shift(w.x), shift(w.y), w.z);
}

/// Samples against the density of eval, integrated over cells in double. Delta lobes and absorbed
/// samples are counted as "elsewhere".
inline DensityTest test_density(const Configuration& c, std::uint64_t count, std::uint64_t seed) {
    auto m = make_material<F32>(c.material);
    auto m64 = make_material<F64>(c.material);
    f64::vec3 wo = f64::normalize3(wide(c.wo)); // grazing, 1e-8 of length turns half vectors
    Random random(seed), rounding(seed + 1);
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
        observed[counts(s) ? bins.find(unrounded(s.wi, rounding)) : bins.size()]++;
    }
    auto tries = static_cast<double>(count);
    double scattered = 0;
    auto density = [&](f64::vec3 wi) { return bsdf_eval(m64, wo, wi).pdf; };
    // Opposite grazing directions have half vectors that turn within a ridge as narrow as the
    // viewer's height; the corner where transmission begins is 2e-4 of a cell, which many samples
    // notice. With so many, cells that the first halvings happen to agree on have lost 2e-5.
    // Lobes like a Gaussian have ends so steep that those of one in a cell of a matte base are
    // missed.
    bool grazing = std::fabs(c.wo.z) < 0.05, steep = is_glossy_kind(c.material.kind);
    bool many = tries > 1e7;
    int certain = DirectionBins::deepest - (grazing || steep ? many ? 5 : 3 : many ? 2 : 0);
    // Of one rectangle; all together miss up to 1e4 times as much of the lobe.
    double tolerance = many ? 1e-11 : 1e-7;
    for (std::size_t i = 0; i < bins.size(); i++) {
        double mass = bins.mass(i, density, tolerance, certain);
        expected[i] = tries * mass;
        scattered += mass;
    }
    double missing = std::max(0.0, 1 - scattered);
    expected[bins.size()] = tries * missing;
    // Normal approximation of the binomial, and the quadrature's own error.
    double sigma = std::sqrt(std::max(missing, 1 / tries) / tries) + 1e-5;
    double off = observed[bins.size()] / tries - (1 - scattered);
    return {chi_square_p(observed, expected), normal_two_sided(off / sigma), scattered};
}

} // namespace parhelion::numerics
