// Running tests of functions: batches side by side, whose findings are put together in their order.
#include "host/parallel.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "host/catalogue/function_test.h"
#include "host/numerics/probe_kernel.h"

namespace parhelion::stress {
namespace {

constexpr int batch_size = 1 << 14;
constexpr int curve_bins = 96;
constexpr int most_measures = 8;

struct Finding {
    double worst = -1, sum = 0;
    std::uint64_t asked = 0;
    std::vector<float> worst_in{};
    std::vector<double> curve = std::vector<double>(curve_bins, -1.0);
};

struct BatchResult {
    std::vector<Finding> findings;
    std::uint64_t differing = 0;
    std::vector<float> differing_in{};
};

bool worse(double error, double than) { return error > than || (error != error && than == than); }

void add_error(Finding& f, double error, const float* in, int words, int bin) {
    if (error == not_asked) return;
    f.asked++;
    f.sum += error;
    if (worse(error, f.worst)) {
        f.worst = error;
        f.worst_in.assign(in, in + words);
    }
    if (bin >= 0 && worse(error, f.curve[bin])) f.curve[bin] = error;
}

void merge(Finding& to, const Finding& from) {
    to.asked += from.asked;
    to.sum += from.sum;
    if (worse(from.worst, to.worst)) {
        to.worst = from.worst;
        to.worst_in = from.worst_in;
    }
    for (int i = 0; i < curve_bins; i++)
        if (worse(from.curve[i], to.curve[i])) to.curve[i] = from.curve[i];
}

void merge(BatchResult& to, const BatchResult& from) {
    to.findings.resize(from.findings.size());
    for (std::size_t i = 0; i < from.findings.size(); i++)
        merge(to.findings[i], from.findings[i]);
    if (to.differing == 0) to.differing_in = from.differing_in;
    to.differing += from.differing;
}

std::string inputs_text(const std::vector<float>& in) {
    std::string text;
    for (float x : in)
        text += fmt::format("{}{:.9g}", text.empty() ? "" : " ", x);
    return text;
}

/// What a thread needs for its batches.
struct Worker {
    ProbeKernel kernel;
    WordArrays in, out;
    Worker(const RenderDevice& device, const Program& program)
        : kernel(device, program, batch_size),
          in(static_cast<std::size_t>(PROBE_INPUTS) * batch_size) {}
};

class Batches {
public:
    Batches(const FunctionTest& test, const ProbeGroup& group)
        : test_(test), number_(probe_number(group, test.probe)), probe_(group.probes[number_]) {}

    BatchResult run(Worker& w, std::uint64_t seed) const {
        Random random(seed);
        draw(w, random);
        w.kernel.run(number_, w.in, w.out);
        BatchResult result;
        result.findings.resize(test_.measures.size());
        for (int at = 0; at < batch_size; at++)
            judge(w, at, result);
        return result;
    }

private:
    void draw(Worker& w, Random& random) const {
        std::array<float, PROBE_INPUTS> words{};
        for (int at = 0; at < batch_size; at++) {
            test_.draw(random, words.data());
            for (int k = 0; k < PROBE_INPUTS; k++)
                w.in[static_cast<std::size_t>(k) * batch_size + at] = words[k];
        }
    }

    /// The host's outputs are judged, and the device's where they are other bits.
    void judge(const Worker& w, int at, BatchResult& result) const {
        f32::ProbeIn in;
        for (int k = 0; k < PROBE_INPUTS; k++)
            in.w[k] = w.in[static_cast<std::size_t>(k) * batch_size + at];
        f32::ProbeOut host = probe_.function(in), device = host;
        bool differs = false;
        for (int k = 0; k < probe_.outputs; k++) {
            device.w[k] = w.out[static_cast<std::size_t>(k) * batch_size + at];
            differs |= !same_bits(host.w[k], device.w[k]);
        }
        add(in, host, result);
        if (!differs) return;
        add(in, device, result);
        if (result.differing++ == 0) result.differing_in.assign(in.w, in.w + PROBE_INPUTS);
    }

    void add(const f32::ProbeIn& in, const f32::ProbeOut& out, BatchResult& result) const {
        std::array<double, most_measures> errors{};
        test_.judge(in.w, out.w, errors.data());
        int bin = -1;
        if (test_.place) {
            double x = (test_.place(in.w) - test_.axis_low) / (test_.axis_high - test_.axis_low);
            if (x >= 0 && x <= 1) bin = std::min(curve_bins - 1, static_cast<int>(x * curve_bins));
        }
        for (std::size_t i = 0; i < test_.measures.size(); i++)
            add_error(result.findings[i], errors[i], in.w, PROBE_INPUTS, bin);
    }

    const FunctionTest& test_;
    int number_;
    const Probe& probe_;
};

Checks checks_of(const FunctionTest& test, const BatchResult& result, std::uint64_t samples) {
    std::string name = test.name.empty() ? test.probe : test.name;
    Checks checks;
    for (std::size_t i = 0; i < test.measures.size(); i++) {
        const Finding& f = result.findings[i];
        Check c{.name = fmt::format("{}: {}", name, test.measures[i].name),
                .value = f.asked > 0 ? std::max(f.worst, 0.0) : NAN,
                .target = test.measures[i].target,
                .unit = test.measures[i].unit,
                .samples = f.asked,
                .mean = f.asked > 0 ? f.sum / static_cast<double>(f.asked) : -1,
                .worst_at = inputs_text(f.worst_in)};
        if (f.worst != f.worst) c.value = NAN;
        if (test.place) c.curve = {test.axis, test.axis_low, test.axis_high, f.curve};
        checks.push_back(c);
    }
    checks.push_back({.name = fmt::format("{}: bits that differ between host and device", name),
                      .value = static_cast<double>(result.differing),
                      .target = 0,
                      .unit = "inputs",
                      .samples = samples,
                      .worst_at = inputs_text(result.differing_in)});
    return checks;
}

} // namespace

Checks run_function_test(StressRun& run, const FunctionTest& test) {
    if (test.measures.size() > most_measures) throw std::logic_error("too many measures");
    std::vector<ProbeGroup> groups = probe_groups();
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const ProbeGroup& g) { return g.name == test.group; });
    const Program& program = run.program(test.group);
    tbb::enumerable_thread_specific<Worker> workers([&] { return Worker(run.device, program); });
    Batches batches(test, *group);
    auto wanted = static_cast<double>(run.count(100'000, 10'000'000, 1'000'000'000)) * test.share;
    auto count = static_cast<std::size_t>(std::ceil(wanted / batch_size));
    // Batches in as many runs as keep threads busy: what each found stays in memory to the end.
    std::size_t runs = std::min<std::size_t>(count, 256);
    std::vector<BatchResult> results(runs);
    std::atomic<std::size_t> finished = 0;
    parallel_for(runs, [&](std::size_t r) {
        for (std::size_t i = count * r / runs; i < count * (r + 1) / runs; i++) {
            merge(results[r],
                  batches.run(workers.local(), run.seed + 0x9e3779b97f4a7c15u * (i + 1)));
            run.done(static_cast<double>(++finished) / static_cast<double>(count));
        }
    });
    BatchResult all;
    for (const BatchResult& result : results)
        merge(all, result);
    return checks_of(test, all, static_cast<std::uint64_t>(count) * batch_size);
}

} // namespace parhelion::stress
