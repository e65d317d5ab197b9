// Host and device compute the same bits: every probe, in every way to compile it.
#include "host/numerics/probes.h"
#include "tests/support/device.h"

using namespace parhelion;
using namespace parhelion::test;
using namespace parhelion::numerics;

namespace {

constexpr int probe_count = 102400;

/// What differs: how many outputs, and the first of them.
struct Difference {
    int words = 0, finite_words = 0; ///< differing; and outputs that are numbers at all
    std::string first;
};

Difference compare(const Probe& probe, const WordArrays& in, const WordArrays& host,
                   const WordArrays& device) {
    Difference d;
    for (int at = 0; at < probe_count; at++) {
        for (int k = 0; k < probe.outputs; k++) {
            std::size_t i = static_cast<std::size_t>(k) * probe_count + at;
            d.finite_words += std::isfinite(host[i]);
            if (same_bits(host[i], device[i]) || d.words++) continue;
            d.first = fmt::format("input {}, output {}: host {:a}, device {:a}; inputs", at, k,
                                  host[i], device[i]);
            for (int j = 0; j < PROBE_INPUTS; j++)
                d.first += fmt::format(" {}", in[static_cast<std::size_t>(j) * probe_count + at]);
        }
    }
    return d;
}

/// 0 differing bits (no number equals no number).
void check_same_bits(const std::string& name) {
    TestDevice d;
    for (const ProbeGroup& group : probe_groups()) {
        if (group.name != name) continue;
        std::vector<WordArrays> inputs, expected;
        for (std::size_t i = 0; i < group.probes.size(); i++) {
            inputs.push_back(probe_inputs(group.probes[i], probe_count, 1000 + i));
            expected.push_back(run_on_host(group.probes[i], inputs.back(), probe_count));
        }
        for (const Variant& variant : variants) {
            Program program = stress_program(d, name, variant.lanes, variant.portable);
            ProbeKernel kernel(d, program, probe_count);
            WordArrays found;
            for (std::size_t i = 0; i < group.probes.size(); i++) {
                CAPTURE(variant.name(), group.probes[i].name);
                kernel.run(static_cast<int>(i), inputs[i], found);
                Difference difference = compare(group.probes[i], inputs[i], expected[i], found);
                CAPTURE(difference.first);
                CHECK(difference.words == 0);
                CHECK(difference.finite_words > probe_count / 2); // most inputs mean something
            }
            program.store(d.cache);
        }
    }
}

} // namespace

#define SAME_BITS(group)                                                                           \
    TEST_CASE("Host and device agree to the bit: " #group, "[device]") { check_same_bits(#group); }
PROBE_GROUPS(SAME_BITS)
