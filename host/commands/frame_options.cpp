// The options of `parhelion render` that are about several renders.
#include "host/commands/render.h"

namespace parhelion {

std::vector<Option> frame_options(RenderCommand& c) {
    return in_group(
        "Several renders: scenes, frames, sweeps (-D angle=0:10:90)",
        {
            {"--frames", &c.frames,
             "Frames to render: 7, 1-10, 1,3,7-20, 1-100x10 (every tenth), 10-1. Each is $frame in "
             "the "
             "scene, as by -D frame=7, and $frame, #### or %04d in names of outputs"},
            {"--skip-existing", &c.skip_existing,
             "Leave out what is there already, whole, of the same scene, options and program; what "
             "such a "
             "render left when it was stopped is replaced"},
            {"--keep-going", &c.keep_going,
             "Go on with the next one where a scene cannot be used; exit code 2 at the end"},
        });
}

} // namespace parhelion
