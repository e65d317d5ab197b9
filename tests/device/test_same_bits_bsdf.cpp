// Host and device compute the same bits: every kind of material.
#define PROBES_HEADER "tests/device/kernels/probes_bsdf.h"
#include "tests/support/same_bits.h"

TEST_CASE("Host and device agree to the bit: every kind of material", "[device]") {
    parhelion::test::check_same_bits();
}
