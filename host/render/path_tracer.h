// Rendering a scene on a device: the wavefront loop.
#pragma once

#include "host/flatten/device_scene.h"
#include "host/image/image.h"
#include "host/progress.h"
#include "host/render/report.h"
#include "host/scene/scene.h"
#include "host/waves/pipeline.h"
#include "host/waves/render_device.h"

namespace parhelion {

struct RenderOptions {
    WorkSplit split;
    int lanes = 0;         ///< 0: what suits the device
    bool portable = false; ///< kernels without x86 intrinsics
    LightChoice light_choice = LightChoice::importance;
    bool checked = false; ///< kernels look after the bounds of buffers: slowly, with one stream
    bool all_features = false; ///< kernels that can do everything, whatever the scene needs
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

/// What is known of a render before it starts, but for the device.
RenderReport start_report(const Scene& scene, const DeviceScene& flat);

/// Ends the step that made `scene`, and tells its notes.
void finish_flattening(const DeviceScene& scene, Progress& progress);

void add_counts(const std::array<std::uint64_t, statistic_count>& statistics, RenderReport& report);

} // namespace parhelion
