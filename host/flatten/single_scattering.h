// The share of light that a rough surface sends on by single scattering, in double.
#pragma once

#include "host/shared_maths.h"

namespace parhelion {

/// Of what one microfacet sends on.
enum class Sent { all, reflected, refracted };

/// A rough conductor or a rough interface, seen from one side. A conductor is taken to reflect
/// everything; tints do not count.
struct RoughSide {
    f64::Material material;
    bool is_interface;
    f64::Interface face;
    Sent sent = Sent::all;
};

/// A record's words in double.
f64::Material widened(const MaterialRecord& record);

/// E(wo): of light from wo, or to wo, the share that leaves so after one microfacet; relative error
/// below 1e-3. wo is on the upper side. `symmetric`: the material is so about wo's plane, and wo.y
/// is 0.
double single_scattering(const RoughSide& side, f64::vec3 wo, bool symmetric);

} // namespace parhelion
