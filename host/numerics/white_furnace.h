// White furnaces: what lossless rough materials give back of light from everywhere, with energy
// compensation.
#pragma once

#include "host/flatten/gauss_legendre.h"
#include "host/flatten/rough_coat.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "host/numerics/energy.h"

#include "host/flatten/single_scattering.h" // last: its macros have short names

namespace parhelion::numerics {

inline const double furnace_roughnesses[] = {1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.7, 1};

/// Reflects or transmits all that it receives, but for single scattering.
inline MaterialCase lossless(int kind, int distribution, double alpha_u, double alpha_v,
                             double index) {
    MaterialCase c{"",        kind,      kind == material_roughdielectric,
                   true,      {1, 1, 1}, {1, 1, 1},
                   {0, 0, 0}, {1, 1, 1}, index,
                   alpha_u,   alpha_v,   distribution};
    c.name = fmt::format("{} {} x {}{}", distribution ? "Beckmann" : "GGX", alpha_u, alpha_v,
                         c.transparent ? fmt::format(", eta {}", index) : "");
    return c;
}

inline RoughSide side_of(const MaterialCase& c, bool outside) {
    auto m = make_material<F64>(c);
    return {m, c.transparent, material_interface(m, outside)};
}

/// What a white rough plastic gives back from wo: what its coat reflects, scaled, and what its base
/// sends on of what comes in from everywhere.
class CoatFurnace {
public:
    explicit CoatFurnace(const MaterialCase& c)
        : material_(make_material<F64>(c)),
          tables_(energy_tables(record_of(make_material<F32>(c)), ENERGY_AZIMUTHS)) {
        material_.distribution |= 1 << 1;
        inner_ = coat_inner_reflectance(record_of(make_material<F32>(c)),
                                        std::span(tables_).last(ENERGY_COSINES), true);
        static const GaussLegendre<64> rule;
        comes_in_ = rule.integrate([&](double x) { // denser at grazing angles
            double c = x * x;
            return 2 * c * 2 * x * let_through({std::sqrt((1 - c) * (1 + c)), 0, c});
        });
    }

    double white(f64::vec3 wo) const {
        RoughSide coat{material_, true, material_interface(material_, true), Sent::reflected};
        double mirrored =
            single_scattering(coat, wo, false) / tabulated_share(tables_, material_, wo);
        double base = comes_in_ / (material_.er * material_.er) / (1 - inner_);
        return mirrored + let_through(wo) * base;
    }
    double inner() const { return inner_; }

private:
    double let_through(f64::vec3 w) const { return tabulated_share(tables_, material_, w, 1); }

    f64::Material material_;
    std::vector<float> tables_;
    double inner_, comes_in_;
};

/// The largest deviation from 1, and where.
struct FurnaceError {
    double worst = 0;
    std::string where;
    void add(double error, const std::string& place) {
        if (std::fabs(error) <= std::fabs(worst)) return;
        worst = error, where = place;
    }
};

/// From the normal to 89.99 degrees.
inline void add_coat_furnaces(int distribution, double alpha, double index, FurnaceError& error) {
    MaterialCase c = lossless(material_roughplastic, distribution, alpha, alpha, index);
    CoatFurnace furnace(c);
    for (double degrees :
         {0., 20., 35., 47., 60., 70., 77., 82., 85., 88., 89., 89.5, 89.9, 89.99}) {
        double theta = degrees * M_PI / 180;
        double white = furnace.white({std::sin(theta), 0, std::cos(theta)});
        error.add(white - 1, fmt::format("{}, eta {}, {} degrees", c.name, index, degrees));
    }
}

/// From the normal to 89.99 degrees, from both sides of what is transparent.
inline void add_furnaces(const MaterialCase& c, const std::vector<double>& azimuths,
                         FurnaceError& error) {
    CompensatedMaterial<F32> compensated(c);
    for (double degrees : {0., 20., 35., 47., 60., 70., 77., 82., 85., 88., 89., 89.5, 89.9, 89.99})
        for (double azimuth : azimuths)
            for (double side : {1., -1.}) {
                if (side < 0 && !c.transparent) continue;
                double theta = degrees * M_PI / 180, sine = std::sin(theta);
                auto wo = vec<F32>(sine * std::cos(azimuth), sine * std::sin(azimuth),
                                   side * std::cos(theta));
                f64::vec3 up = vec<F64>(wo.x, wo.y, std::fabs(wo.z));
                double white =
                    single_scattering(side_of(c, side > 0), up, false) * compensated.gain(wo).x;
                error.add(white - 1, fmt::format("{}, {} degrees {}, azimuth {:.2f}", c.name,
                                                 degrees, side > 0 ? "above" : "below", azimuth));
            }
}

} // namespace parhelion::numerics
