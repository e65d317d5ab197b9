// Makes the host's list of one group of probes: included once, by the group's own file, which
// defines PROBES_HEADER and PROBES_OF_GROUP.
#include "host/numerics/probes.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
namespace parhelion::f32 {
#include PROBES_HEADER
} // namespace parhelion::f32
#pragma GCC diagnostic pop

namespace parhelion::numerics {

std::span<const Probe> PROBES_OF_GROUP() {
#define PROBE(name, inputs, outputs) {#name, inputs, outputs, f32::probe_##name},
    static constexpr Probe list[] = {PROBES};
    return list;
}

} // namespace parhelion::numerics
