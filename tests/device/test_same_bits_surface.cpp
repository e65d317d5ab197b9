// Host and device compute the same bits: intersections, surfaces and camera rays.
#include "tests/support/probes.h"

using namespace parhelion;
using namespace parhelion::test;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
namespace parhelion::f32 {
#include "tests/device/kernels/probes_surface.h"
} // namespace parhelion::f32
#pragma GCC diagnostic pop

#define PROBE(name, inputs, outputs) {#name, inputs, outputs, f32::probe_##name},
TEST_CASE("Host and device agree to the bit: intersections, surfaces and camera rays", "[device]") {
    const Probe probes[] = {PROBES};
    check_same_bits("probes_surface.h", probes);
}
