// Host and device compute the same bits: intersections, surfaces and camera rays.
#define PROBES_HEADER "tests/device/kernels/probes_surface.h"
#include "tests/support/same_bits.h"

TEST_CASE("Host and device agree to the bit: intersections, surfaces and camera rays", "[device]") {
    parhelion::test::check_same_bits();
}
