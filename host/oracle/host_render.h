// Rendering a scene with the kernels compiled as C++: slowly, and without a device.
#pragma once

#include "host/render/path_tracer.h"

namespace parhelion {

/// The image is the one that render() makes on any device, to the bit. Work is shared out among the
/// threads of oneTBB.
RenderResult render_on_host(const Scene& scene, const RenderOptions& options, Progress& progress);

} // namespace parhelion
