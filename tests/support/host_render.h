// Rendering inside a test with the kernels compiled as C++.
#pragma once

#include "host/render/host_render.h"

namespace parhelion::test {

inline RenderResult host_render(const Scene& scene, Precision precision,
                                const RenderOptions& options = {}) {
    Progress quiet(Progress::Mode::quiet);
    return render_on_host(scene, options, precision, quiet);
}

} // namespace parhelion::test
