// A test file for the probes of one header: define PROBES_HEADER, include this, call
// check_same_bits in a test case.
#pragma once

#include "tests/support/probes.h"

#include <filesystem>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
namespace parhelion::f32 {
#include PROBES_HEADER
} // namespace parhelion::f32
#pragma GCC diagnostic pop

namespace parhelion::test {

#define PROBE(name, inputs, outputs) {#name, inputs, outputs, f32::probe_##name},
inline void check_same_bits() {
    const Probe probes[] = {PROBES};
    check_same_bits(std::filesystem::path(PROBES_HEADER).filename(), probes);
}

} // namespace parhelion::test
