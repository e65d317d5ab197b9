// Probes (kernels/stress): shared functions as words in, words out, on the host.
#pragma once

#include "host/shared_maths.h"

#include <bit>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
namespace parhelion::f32 {
#include "kernels/stress/probe_words.h"
} // namespace parhelion::f32
#pragma GCC diagnostic pop

namespace parhelion::numerics {

// Each is a program of its own: kernels/stress/<group>.cl.
#define PROBE_GROUPS(X) X(maths) X(surface) X(bsdf) X(emitter) X(film)

struct Probe {
    const char* name;
    const char* inputs; ///< letters of probe_inputs.h
    int outputs;
    f32::ProbeOut (*function)(f32::ProbeIn);
};

#define DECLARE_PROBES(group) std::span<const Probe> probes_of_##group();
PROBE_GROUPS(DECLARE_PROBES)

struct ProbeGroup {
    std::string name;
    std::span<const Probe> probes;
};
std::vector<ProbeGroup> probe_groups();

/// Where a probe stands. Throws std::logic_error for a name that is not in the group.
int probe_number(const ProbeGroup& group, std::string_view name);

/// Words of `count` probes: PROBE_INPUTS arrays in, PROBE_OUTPUTS arrays out.
using WordArrays = std::vector<float>;

/// Inputs by the letters of a probe.
WordArrays probe_inputs(const Probe& probe, int count, std::uint64_t seed);

WordArrays run_on_host(const Probe& probe, const WordArrays& in, int count);

/// The same bits, or both no number.
inline bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a != a && b != b);
}

} // namespace parhelion::numerics
