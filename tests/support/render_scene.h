// Rendering a scene file inside a test.
#pragma once

#include "host/commands/render.h"
#include "host/numerics/image_figures.h"
#include "host/render/device_render.h"
#include "host/scene/load.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

namespace parhelion::test {

using numerics::mean_rgb;

/// The device of this test process: PARHELION_DEVICE, or the default one.
RenderDevice& test_device();

inline std::string source_file(const std::string& path) {
    return fmt::format("{}/{}", PARHELION_SOURCE_DIR, path);
}

/// Loads with the command's definitions and overrides applied, as `parhelion render` does.
inline Scene load(const RenderCommand& command) {
    Scene scene = load_scene(command.scene_file,
                             {parse_definitions(command.definitions), command.allow_outside});
    apply_overrides(command, scene);
    return scene;
}

inline RenderResult render_quietly(const Scene& scene, const RenderOptions& options = {}) {
    Progress quiet(Progress::Mode::quiet);
    return render(scene, test_device(), options, quiet);
}

} // namespace parhelion::test
