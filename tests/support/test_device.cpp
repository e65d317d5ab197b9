// The device that tests render on.
#include "host/waves/render_device.h"
#include "tests/support/render_scene.h"

#include <cstdlib>

namespace parhelion::test {

RenderDevice& test_device() {
    static RenderDevice device = [] {
        const char* selector = std::getenv("PARHELION_DEVICE");
        return RenderDevice(choose_device(selector ? selector : ""));
    }();
    return device;
}

} // namespace parhelion::test
