// Functions of the kernels that read tables, as C++ in single precision: for the stress test to ask
// alone.
#pragma once

#include "host/flatten/device_scene.h"

#include <array>
#include <span>

namespace parhelion {

struct PickedLight {
    int row;
    float pmf, pmf_hint; ///< as pick_light of kernels/device/light_table.h has them
};

/// One of two or more lights for a surface at p with the unit normal n. x chooses, y refills its
/// digits: 32 random bits each.
PickedLight pick_light(const LightTree& tree, const std::array<float, 3>& p,
                       const std::array<float, 3>& n, std::uint32_t x, std::uint32_t y);

/// The hint of pick_light for a row of the light table.
float light_pmf(const LightTree& tree, const std::array<float, 3>& p, int row);

struct FilterOffset {
    float offset, weight; ///< pixels from the pixel's centre; what the sample counts for
};

/// A table of make_filter_table, u in [0, 1).
FilterOffset sample_filter(std::span<const FilterBin> table, float u);

struct SkyRadiance {
    std::array<float, 3> radiance;
    float pdf; ///< of next event estimation, solid angle
};

/// What is seen of the scene's envmap or sunsky towards w (unit): sky_seen and daylight_seen of
/// kernels/device.
SkyRadiance sky_seen(const DeviceScene& scene, const std::array<float, 3>& w);

struct SkyDirection {
    std::array<float, 3> wi, weight; ///< radiance over density
    float inverse_pdf;
};

/// The direction that next event estimation chooses by 32 random bits each: sky_chosen,
/// daylight_chosen.
SkyDirection sky_chosen(const DeviceScene& scene, std::uint32_t x, std::uint32_t y);

} // namespace parhelion
