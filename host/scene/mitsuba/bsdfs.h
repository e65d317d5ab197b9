// The readers of bsdf plugins that are one material, from the list in kernels/shared/materials.h.
#pragma once

#include "host/scene/material.h"

namespace parhelion::mitsuba {

class Properties;

#define DECLARE_BSDF_READER(name, ...) Bsdf read_##name(Properties& p);
MATERIALS(DECLARE_BSDF_READER)
#undef DECLARE_BSDF_READER

} // namespace parhelion::mitsuba
