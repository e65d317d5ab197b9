// Rendering a scene with the kernels compiled as C++: slowly, and without a device.
#pragma once

#include "host/render/device_render.h"

namespace parhelion {

enum class Precision { single_precision, double_precision };

/// In single precision the image is the one that render() makes on any device, to the bit. In
/// double precision the same kernels make it from the same records and random numbers, so that it
/// differs by what rounding does to the device's. Work is shared out among the threads of oneTBB;
/// it does not depend on them.
OpenedRender open_on_host(const Scene& scene, const RenderOptions& options, Precision precision,
                          Progress& progress);

/// All of it.
RenderResult render_on_host(const Scene& scene, const RenderOptions& options, Precision precision,
                            Progress& progress);

} // namespace parhelion
