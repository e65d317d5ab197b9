// A material as the device reads it.
#pragma once

#include "host/scene/scene.h"
#include "kernels/shared/types.h"

namespace parhelion {

MaterialRecord material_record(const Bsdf& bsdf);

} // namespace parhelion
