// What single precision loses of shapes that are small for their place.
#pragma once

#include "host/flatten/scene_frame.h"

#include <string>
#include <vector>

namespace parhelion {

/// A line for each shape whose faces (of large meshes: some thousands of them) would have a
/// hundredth of their area more or less for the rounding of their corners on the device, or whose
/// sphere, cylinder or disk is moved by a hundredth of its size; and for each that is less than
/// 2^-41 of the scene. What of them is seen is not right.
std::vector<std::string> rounding_notes(const Scene& scene, const SceneFrame& frame);

} // namespace parhelion
