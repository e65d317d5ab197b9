// What the rows of skies share: draws of directions whose density and weight are held against what
// is seen there, and their checks.
#pragma once

#include "host/catalogue/check.h"
#include "host/numerics/every_kind_scene.h"
#include "host/numerics/measure.h"
#include "host/twin/device_functions.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace parhelion::stress {

/// Relative differences.
struct SkyWorst {
    Worst density, weight;

    /// A drawn direction's density beside the one that is asked for, and its weight beside the
    /// radiance over that.
    void add(const DeviceScene& flat, const SkyDirection& chosen) {
        SkyRadiance seen = sky_seen(flat, chosen.wi);
        density.add(std::fabs(double{seen.pdf} * chosen.inverse_pdf - 1));
        weight.add(
            std::fabs(chosen.weight[0] / (double{seen.radiance[0]} * chosen.inverse_pdf) - 1));
    }
};

inline Check sky_check(const std::string& row, const std::string& name, double value, double target,
                       std::string unit, std::uint64_t samples) {
    return {.name = row + ": " + name,
            .value = value,
            .target = target,
            .unit = std::move(unit),
            .samples = samples};
}

/// A matte square under one sky.
inline Scene scene_under(const std::string& name, const Emitter& sky) {
    Scene scene;
    scene.file = name;
    scene.materials.push_back({"", {}, DiffuseBsdf{}});
    scene.shapes.push_back(shape_of(quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}), 0, no_material));
    scene.emitters.push_back(sky);
    return scene;
}

} // namespace parhelion::stress
