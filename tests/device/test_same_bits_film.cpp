// Host and device compute the same bits: the film's sums and spreads.
#define PROBES_HEADER "tests/device/kernels/probes_film.h"
#include "tests/support/same_bits.h"

TEST_CASE("Host and device agree to the bit: the film's sums and spreads", "[device]") {
    parhelion::test::check_same_bits();
}
