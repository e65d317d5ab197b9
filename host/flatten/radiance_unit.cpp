// The unit that the device adds up light in.
#include "host/flatten/radiance_unit.h"

#include <algorithm>
#include <cmath>

namespace parhelion {
namespace {

constexpr int ordinary = 40; // exponents of radiance, to either side of 0
constexpr int most = 80;     // of what can be added up
constexpr int held = 120; // of a light's own record: an intensity counts for its distance squared
constexpr int dim = -20;  // what the brightest light becomes where all are dimmer than ordinary
constexpr double scene_size = 0x1p10; // device units

double log2_square(double v) { return 2.0 * std::log2(v); }

/// Powers of two of the lights' radiance.
struct Exponents {
    double brightest = -INFINITY; ///< lights without size: seen from the scene, or from one unit
    double across = -INFINITY;    ///< irradiance at the other end of the scene
    double record = -INFINITY;    ///< radiance or intensity
};

bool has_place_only(const LightRow& row) {
    return row.kind == emitter_point || row.kind == emitter_spot || row.kind == emitter_projector;
}

Exponents exponents_of(const LightRow& row) {
    double radiance =
        std::log2(row.peak * std::max({row.radiance.r, row.radiance.g, row.radiance.b}));
    if (has_place_only(row))
        return {radiance - log2_square(std::max(row.distance, 1.0)),
                radiance - log2_square(row.distance + scene_size), radiance};
    double share = row.area > 0.0 ? std::min(1.0, row.area / (scene_size * scene_size)) : 1.0;
    return {radiance, radiance + std::log2(share), radiance};
}

Exponents largest(std::span<const LightRow> rows) {
    Exponents all;
    for (const LightRow& row : rows) {
        Exponents e = exponents_of(row);
        all.brightest = std::max(all.brightest, e.brightest);
        all.across = std::max(all.across, e.across);
        all.record = std::max(all.record, e.record);
    }
    return all;
}

} // namespace

double radiance_unit(std::span<const LightRow> rows) {
    Exponents e = largest(rows);
    double exponent = 0.0;
    if (e.brightest > ordinary)
        exponent = std::max(
            {e.brightest - most, std::min(e.brightest - ordinary, e.across + ordinary), 0.0});
    else if (e.brightest < -ordinary && std::isfinite(e.brightest))
        exponent = e.brightest - dim;
    exponent = std::max(exponent, e.record - held);
    return std::exp2(std::floor(exponent));
}

} // namespace parhelion
