// Running probes (tests/device/kernels/probes_*.h) on the host and on the device, and comparing
// their bits.
#pragma once

#include "tests/support/device.h"
#include "tests/support/probe_inputs.h"

#include <span>

namespace parhelion::f32 {
#include "tests/device/kernels/probe_words.h"
} // namespace parhelion::f32

namespace parhelion::test {

struct Probe {
    const char* name;
    const char* inputs; ///< letters of probe_inputs.h
    int outputs;
    f32::ProbeOut (*function)(f32::ProbeIn);
};

inline constexpr int probe_count = 102400; // a multiple of every chunk of the kernel

/// PROBE_INPUTS arrays of probe_count words; words that the probe does not read are 0.
inline std::vector<float> probe_arrays(const Probe& probe, std::uint64_t seed) {
    std::vector<float> arrays(static_cast<std::size_t>(PROBE_INPUTS) * probe_count);
    ProbeInputs inputs(seed);
    for (int at = 0; at < probe_count; at++) {
        Words words = inputs.words(probe.inputs);
        for (std::size_t k = 0; k < words.size(); k++)
            arrays[k * probe_count + at] = words[k];
    }
    return arrays;
}

inline std::vector<float> run_on_host(const Probe& probe, const std::vector<float>& arrays) {
    std::vector<float> out(static_cast<std::size_t>(PROBE_OUTPUTS) * probe_count);
    for (int at = 0; at < probe_count; at++) {
        f32::ProbeIn in;
        for (int k = 0; k < PROBE_INPUTS; k++)
            in.w[k] = arrays[static_cast<std::size_t>(k) * probe_count + at];
        f32::ProbeOut o = probe.function(in);
        for (int k = 0; k < PROBE_OUTPUTS; k++)
            out[static_cast<std::size_t>(k) * probe_count + at] = o.w[k];
    }
    return out;
}

inline std::vector<float> run_on_device(const TestDevice& d, const Program& program, int which,
                                        const std::vector<float>& arrays) {
    constexpr int chunk = 256;
    Buffer<float> in = device_copy(d, "probe inputs", arrays);
    Buffer<float> out(d.context, "probe outputs",
                      static_cast<std::size_t>(PROBE_OUTPUTS) * probe_count);
    cl::Kernel kernel = program.kernel("probe");
    kernel.setArg(0, in.handle());
    kernel.setArg(1, out.handle());
    kernel.setArg(2, probe_count);
    kernel.setArg(3, which);
    d.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(probe_count / chunk),
                                 cl::NDRange(1));
    return host_copy(d, out);
}

/// What differs: how many outputs, and the first of them.
struct Difference {
    int words = 0, finite_words = 0; ///< differing; and outputs that are numbers at all
    std::string first;
};

inline Difference compare(const Probe& probe, const std::vector<float>& in,
                          const std::vector<float>& host, const std::vector<float>& device) {
    Difference d;
    for (int at = 0; at < probe_count; at++) {
        for (int k = 0; k < probe.outputs; k++) {
            std::size_t i = static_cast<std::size_t>(k) * probe_count + at;
            d.finite_words += std::isfinite(host[i]);
            bool same =
                std::bit_cast<std::uint32_t>(host[i]) == std::bit_cast<std::uint32_t>(device[i]) ||
                (std::isnan(host[i]) && std::isnan(device[i]));
            if (same || d.words++) continue;
            d.first = fmt::format("input {}, output {}: host {:a}, device {:a}; inputs", at, k,
                                  host[i], device[i]);
            for (int j = 0; j < PROBE_INPUTS; j++)
                d.first += fmt::format(" {}", in[static_cast<std::size_t>(j) * probe_count + at]);
        }
    }
    return d;
}

/// Every probe of a file, in every way to compile it: 0 differing bits (no number equals no
/// number).
inline void check_same_bits(const std::string& file, std::span<const Probe> probes) {
    TestDevice d;
    std::vector<std::vector<float>> inputs, expected;
    for (std::size_t i = 0; i < probes.size(); i++) {
        inputs.push_back(probe_arrays(probes[i], 1000 + i));
        expected.push_back(run_on_host(probes[i], inputs.back()));
    }
    for (const Variant& variant : variants) {
        Program program =
            test_program(d, {"probe_begin.h", "probe_words.h", file, "probe.cl"}, variant);
        for (std::size_t i = 0; i < probes.size(); i++) {
            CAPTURE(variant.name(), probes[i].name);
            std::vector<float> found = run_on_device(d, program, static_cast<int>(i), inputs[i]);
            Difference difference = compare(probes[i], inputs[i], expected[i], found);
            CAPTURE(difference.first);
            CHECK(difference.words == 0);
            CHECK(difference.finite_words > probe_count / 2); // most inputs mean something
        }
    }
}

} // namespace parhelion::test
