// The camera as the device reads it.
#pragma once

#include "host/flatten/scene_frame.h"
#include "kernels/shared/types.h"

namespace parhelion {

/// Full horizontal angle of view in radians, from whichever of angle and focal length the scene
/// gives.
double horizontal_fov(const Camera& camera, int width, int height);

CameraRecord camera_record(const Camera& camera, int width, int height, const SceneFrame& frame);

} // namespace parhelion
