// Our own comparison scenes by the kernels compiled as C++, in small, against stored figures of
// Mitsuba's: what is plainly wrong shows in seconds. tests/render has the same on the device,
// finer.
#include "tests/support/mitsuba_figures.h"

#include "host/render/host_render.h"

using namespace parhelion;
using namespace parhelion::test::mitsuba_figures;

TEST_CASE("Pictures are roughly Mitsuba's, region by region", "[mitsuba]") {
    Effort effort{12, 1, [](const Scene& scene) {
                      Progress quiet(Progress::Mode::quiet);
                      return render_on_host(scene, {}, Precision::single_precision, quiet);
                  }};
    check_all_cases(effort, 1e-3);
}
