// Host and device compute the same bits: every kind of emitter.
#define PROBES_HEADER "tests/device/kernels/probes_emitter.h"
#include "tests/support/same_bits.h"

TEST_CASE("Host and device agree to the bit: every kind of emitter", "[device]") {
    parhelion::test::check_same_bits();
}
