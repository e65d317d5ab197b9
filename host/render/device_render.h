// Rendering a scene on a device.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/image/image.h"
#include "host/progress.h"
#include "host/render/engine.h"
#include "host/scene/scene.h"
#include "host/waves/work_sizes.h"

#include <sys/types.h> // ulong, as the kernels call it

#include <span>

namespace parhelion {

struct RenderDevice; // host/waves/render_device.h

struct RenderOptions {
    WorkSplit split;
    int lanes = 0;         ///< 0: what suits the device
    bool portable = false; ///< kernels without x86 intrinsics
    LightChoice light_choice = LightChoice::importance;
    bool checked = false;     ///< kernels look after the bounds of buffers: slowly, with one stream
    std::uint64_t memory = 0; ///< bytes that host and device may have each; 0: no limit
    std::uint64_t group_memory = 0; ///< bytes that the process's control group allows; 0: no limit
    std::string scratch = ".";      ///< folder for a film that is more than fits into memory
    bool all_features = false;      ///< kernels that can do everything, whatever the scene needs
};

/// What the kernels of an image have.
FeatureSet render_features(const DeviceScene& scene, const RenderOptions& options);

struct RenderResult {
    Image image;
    RenderReport report;
};

/// Renders a scene whose film has its crop resolved. The image depends on the scene (and its seed)
/// alone, to the bit.
RenderResult render(const Scene& scene, RenderDevice& device, const RenderOptions& options,
                    Progress& progress);

/// What render() does in one go, up to the first wave. `scene` and `device` must outlive it.
OpenedRender open_on_device(const Scene& scene, RenderDevice& device, const RenderOptions& options,
                            Progress& progress);

/// As records, with what the report says of scene and picture. `before`: as flatten_scene has it.
DeviceScene flattened(const Scene& scene, LightChoice light_choice, Progress& progress,
                      RenderReport& report, DeviceScene* before = nullptr);

/// Renders all of it.
RenderResult rendered(OpenedRender opened, Progress& progress);

/// `of_segments`: STATISTICS and FAULTS of each.
TraceCounts counts_of(std::span<const ulong> of_segments);

} // namespace parhelion
