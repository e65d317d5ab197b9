// Host and device compute the same bits: every kind of emitter.
#include "tests/support/probes.h"

using namespace parhelion;
using namespace parhelion::test;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
namespace parhelion::f32 {
#include "tests/device/kernels/probes_emitter.h"
} // namespace parhelion::f32
#pragma GCC diagnostic pop

#define PROBE(name, inputs, outputs) {#name, inputs, outputs, f32::probe_##name},
TEST_CASE("Host and device agree to the bit: every kind of emitter", "[device]") {
    const Probe probes[] = {PROBES};
    check_same_bits("probes_emitter.h", probes);
}
