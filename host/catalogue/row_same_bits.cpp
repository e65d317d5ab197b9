// Every shared function through its probe, on inputs that are random and nasty: the device's bits
// are the host's.
#include "host/catalogue/rows.h"

#include <cmath>

#include "host/numerics/probes.h"

namespace parhelion::stress {
namespace {

constexpr int probe_count = 102400;

Check compare(const ProbeGroup& group, int number, ProbeKernel& kernel, std::uint64_t rounds,
              std::uint64_t seed) {
    const Probe& probe = group.probes[number];
    std::uint64_t differing = 0;
    WordArrays device;
    for (std::uint64_t round = 0; round < rounds; round++) {
        WordArrays in = probe_inputs(probe, probe_count, seed + 7919 * round + number);
        WordArrays host = run_on_host(probe, in, probe_count);
        kernel.run(number, in, device);
        for (std::size_t i = 0; i < static_cast<std::size_t>(probe.outputs) * probe_count; i++)
            differing += !same_bits(host[i], device[i]);
    }
    return {.name = fmt::format("{}: outputs that differ", probe.name),
            .value = static_cast<double>(differing),
            .target = 0,
            .unit = "outputs",
            .samples = rounds * probe_count};
}

} // namespace

Checks row_same_bits(StressRun& run) {
    Checks checks;
    std::vector<ProbeGroup> groups = probe_groups();
    for (std::size_t g = 0; g < groups.size(); g++) {
        ProbeKernel kernel(run.device, run.program(groups[g].name), probe_count);
        for (std::size_t i = 0; i < groups[g].probes.size(); i++) {
            checks.push_back(
                compare(groups[g], static_cast<int>(i), kernel, run.count(1, 2, 100), run.seed));
            run.done((static_cast<double>(g) +
                      static_cast<double>(i) / static_cast<double>(groups[g].probes.size())) /
                     static_cast<double>(groups.size()));
        }
    }
    return checks;
}

} // namespace parhelion::stress
