// The camera as the device reads it.
#pragma once

#include "host/flatten/scene_frame.h"
#include "kernels/shared/types.h"

namespace parhelion {

CameraRecord camera_record(const Camera& camera, int width, int height, const SceneFrame& frame);

} // namespace parhelion
