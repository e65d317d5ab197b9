// Every shared function through its probe, on inputs that are random and nasty: the device's bits
// are the host's.
#include "host/catalogue/rows.h"

#include <cmath>
#include <string_view>

#include "host/numerics/probe_kernel.h"

namespace parhelion::stress {
namespace {

constexpr int probe_count = 102400;

struct Compared {
    std::uint64_t differing = 0, finite = 0, outputs = 0;
    std::string first; ///< of those that differ
};

std::string text_of(const Probe& probe, std::size_t word, const WordArrays& in, float host,
                    float device) {
    std::string text =
        fmt::format("output {}, host {:a}, device {:a}; inputs", word / probe_count, host, device);
    for (std::size_t k = 0; k < std::string_view(probe.inputs).size(); k++)
        text += fmt::format(" {}", in[k * probe_count + word % probe_count]);
    return text;
}

Compared compare(const Probe& probe, int number, ProbeKernel& kernel, std::uint64_t rounds,
                 std::uint64_t seed) {
    Compared c;
    WordArrays device;
    for (std::uint64_t round = 0; round < rounds; round++) {
        WordArrays in = probe_inputs(probe, probe_count, seed + 7919 * round + number);
        WordArrays host = run_on_host(probe, in, probe_count);
        kernel.run(number, in, device);
        for (std::size_t i = 0; i < static_cast<std::size_t>(probe.outputs) * probe_count; i++) {
            c.outputs++;
            c.finite += std::isfinite(host[i]);
            if (same_bits(host[i], device[i]) || c.differing++ > 0) continue;
            c.first = text_of(probe, i, in, host[i], device[i]);
        }
    }
    return c;
}

void add_checks(Checks& checks, const Probe& probe, const Compared& c) {
    checks.push_back({.name = fmt::format("{}: outputs that differ", probe.name),
                      .value = static_cast<double>(c.differing),
                      .target = 0,
                      .unit = "outputs",
                      .samples = c.outputs / static_cast<std::uint64_t>(probe.outputs),
                      .worst_at = c.first});
    // Most inputs must mean something. Of probes of several outputs, a word a probe.
    checks.push_back(
        {.name = fmt::format("{}: numbers among a probe's outputs", probe.name),
         .value = static_cast<double>(c.finite) * probe.outputs / static_cast<double>(c.outputs),
         .target = 0.5,
         .at_least = true,
         .unit = "a probe",
         .samples = c.outputs});
}

} // namespace

Checks row_same_bits(StressRun& run) {
    Checks checks;
    std::vector<ProbeGroup> groups = probe_groups();
    for (std::size_t g = 0; g < groups.size(); g++) {
        ProbeKernel kernel(run.device, run.program(groups[g].name), probe_count);
        for (std::size_t i = 0; i < groups[g].probes.size(); i++) {
            const Probe& probe = groups[g].probes[i];
            add_checks(checks, probe,
                       compare(probe, static_cast<int>(i), kernel, run.count(1, 2, 100), run.seed));
            run.done((static_cast<double>(g) +
                      static_cast<double>(i) / static_cast<double>(groups[g].probes.size())) /
                     static_cast<double>(groups.size()));
        }
    }
    return checks;
}

} // namespace parhelion::stress
