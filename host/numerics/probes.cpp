// Probes on the host.
#include "host/numerics/probes.h"

#include "host/numerics/probe_inputs.h"

#include <fmt/format.h>

#include <stdexcept>

namespace parhelion::numerics {
namespace {

std::size_t at_word(int word, int count, int at) {
    return static_cast<std::size_t>(word) * count + at;
}

} // namespace

std::vector<ProbeGroup> probe_groups() {
#define LIST_GROUP(group) {#group, probes_of_##group()},
    return {PROBE_GROUPS(LIST_GROUP)};
}

int probe_number(const ProbeGroup& group, std::string_view name) {
    for (std::size_t i = 0; i < group.probes.size(); i++)
        if (group.probes[i].name == name) return static_cast<int>(i);
    throw std::logic_error(fmt::format("no probe {} among {}", name, group.name));
}

WordArrays probe_inputs(const Probe& probe, int count, std::uint64_t seed) {
    WordArrays arrays(at_word(PROBE_INPUTS, count, 0));
    ProbeInputs inputs(seed);
    for (int at = 0; at < count; at++) {
        Words words = inputs.words(probe.inputs);
        for (std::size_t k = 0; k < words.size(); k++)
            arrays[k * count + at] = words[k];
    }
    return arrays;
}

WordArrays run_on_host(const Probe& probe, const WordArrays& in, int count) {
    WordArrays out(at_word(PROBE_OUTPUTS, count, 0));
    for (int at = 0; at < count; at++) {
        f32::ProbeIn i;
        for (int k = 0; k < PROBE_INPUTS; k++)
            i.w[k] = in[at_word(k, count, at)];
        f32::ProbeOut o = probe.function(i);
        for (int k = 0; k < PROBE_OUTPUTS; k++)
            out[at_word(k, count, at)] = o.w[k];
    }
    return out;
}

} // namespace parhelion::numerics
