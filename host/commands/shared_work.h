// What the renders of one process have in common.
#pragma once

#include "host/clock.h"
#include "host/commands/render_messages.h"
#include "host/error.h"
#include "host/file_digests.h"
#include "host/progress.h"
#include "host/scene/meshes/kept_meshes.h"
#include "host/waves/render_device.h"

namespace parhelion {

/// Made when the process begins; each render finds in it what those before it left.
struct SharedWork {
    const RenderMessages& messages;
    Progress& progress;
    bool several = false; ///< else nothing is kept for the next
    Clock::time_point started = Clock::now();
    RenderDevice* device = nullptr; ///< with its programs and texels; null: not opened yet
    KeptMeshes meshes{};
    FileDigests digests{};

    /// What is kept of scenes.
    void forget_scenes() {
        meshes = {};
        if (device) device->scene.reset();
    }
};

/// Whether its output is there already, whole. Throws InputError for a scene that cannot be used,
/// or an output of another render.
bool is_done(const RenderCommand& command, SharedWork& work);

/// Renders and writes. Throws InputError, DeviceError, OutputError.
ExitCode render_one(const RenderCommand& command, SharedWork& work);

} // namespace parhelion
