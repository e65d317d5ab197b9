// Burley's materials for tests: numbers for all of their lobes, and what those send on.
#pragma once

#include "host/shared_maths.h"

#include <algorithm>
#include <cmath>

namespace parhelion::numerics {

inline bool is_principled_kind(int kind) {
    return kind == material_principled || kind == material_principledthin;
}

/// What a case tells of one.
struct PrincipledCase {
    bool thin, glass; // glass: or no lobe is missing
    double index, alpha_u, alpha_v;
};

/// Its colour is there already.
template<class Material>
void set_principled(Material& m, const PrincipledCase& c) {
    using Real = decltype(m.r);
    m.er = Real(c.index);
    m.alpha_v = Real(std::min(1.0, std::fabs(1 - c.alpha_u / c.alpha_v)));
    m.alpha_u = Real(std::sqrt(c.alpha_u));
    METALLIC(m) = Real(c.glass ? 0 : 0.3), SPEC_TRANS(m) = Real(c.glass ? 1 : 0.4);
    SPEC_TINT(m) = Real(c.glass ? 0 : 0.6);
    SHEEN(m) = Real(c.glass ? 0 : 0.8), SHEEN_TINT(m) = Real(0.7), FLATNESS(m) = Real(0.3);
    CLEARCOAT_GLOSS(m) = Real(0.2);
    CLEARCOAT(m) = Real(c.glass ? 0 : c.thin ? 1.2 : 0.9); // of a sheet diff_trans
    m.distribution = 0;
}

/// What Burley's white base sends on, to a viewer at that cosine: his formulas (2012, section 5.3;
/// 2015, section 4) by the midpoint rule over cosine and azimuth. Up to 1.56: it is no more exact
/// than that.
inline double sent_on_by_base(double roughness, double flatness, double cosine) {
    constexpr int cosines = 100, azimuths = 32;
    auto schlick = [](double c) { return std::pow(1 - c, 5); };
    double sum = 0;
    for (int k = 0; k < cosines; k++)
        for (int n = 0; n < azimuths; n++) {
            double c = (k + 0.5) / cosines, azimuth = M_PI * (n + 0.5) / azimuths;
            double sines = std::sqrt((1 - c * c) * (1 - cosine * cosine));
            double half_squared = (1 + c * cosine + sines * std::cos(azimuth)) / 2;
            double edge = roughness * half_squared; // of the layer; 0.5 + twice that of the base
            double base =
                (1 + (2 * edge - 0.5) * schlick(c)) * (1 + (2 * edge - 0.5) * schlick(cosine));
            double layer = (1 + (edge - 1) * schlick(c)) * (1 + (edge - 1) * schlick(cosine));
            double flat = 1.25 * (layer * (1 / (c + cosine) - 0.5) + 0.5);
            sum += 2 * c * (base + flatness * (flat - base)) / (cosines * azimuths);
        }
    return sum;
}

/// The most that one sends on of what it receives: its interface all, where the reflectance of no
/// hue is above 1; its base what stands above, its sheen 0.0882, its coat 0.04 (Schlick's
/// reflectance times the cosine squared, by which it is not divided).
inline double most_sent_on(const f64::Material& m) {
    double base = 0;
    for (int k = 0; k <= 50; k++)
        base = std::max(base, sent_on_by_base(m.alpha_u, FLATNESS(m), k / 50.0 + 1e-6));
    f64::vec3 hue = f64::hue_of(f64::material_reflectance(m));
    double tint = std::max(1.0, 1 + SHEEN_TINT(m) * (f64::max_component(hue) - 1));
    double color = std::max({m.r, m.g, m.b}), sheen = 0.0882 * SHEEN(m) * tint;
    if (m.kind == material_principled)
        return 1 + (1 - METALLIC(m)) * ((1 - SPEC_TRANS(m)) * color * base + sheen) +
               0.04 * CLEARCOAT(m);
    double through = DIFF_TRANS(m) / 2;
    return SPEC_TRANS(m) +
           (1 - SPEC_TRANS(m)) * ((1 - through) * (color * base + sheen) + through * color);
}

} // namespace parhelion::numerics
