// Host and device compute the same bits: vectors, elementary functions, sampler, warps, frames,
// Fresnel terms and microfacets.
#define PROBES_HEADER "tests/device/kernels/probes_maths.h"
#include "tests/support/same_bits.h"

TEST_CASE("Host and device agree to the bit: vectors, elementary functions, sampler, warps, "
          "frames, Fresnel terms and microfacets",
          "[device]") {
    parhelion::test::check_same_bits();
}
