// Compiling the stages' programs, side by side, and what was compiled before not again.
#include "host/render/stage_programs.h"

#include "host/cl/buffer.h"
#include "host/cl/work_groups.h"
#include "host/clock.h"
#include "host/error.h"
#include "host/render/kernel_arguments.h"
#include "kernels/device/bounds.h"

#include <sys/types.h> // ulong, as the kernels call it

#include <algorithm>
#include <future>
#include <optional>
#include <utility>

namespace parhelion {
namespace {

ProgramSource group_source(ProgramGroup group, const StageOptions& options) {
    // Intrinsics have no bounds.
    ProgramOptions program{options.lanes, 0, options.portable || options.checked, options.checked};
    std::vector<std::string> files;
    for (std::size_t i = 0; i < stage_count; i++) {
        if (stage_groups[i] != group) continue;
        program.features |= options.features & stage_features(static_cast<Stage>(i));
        files.push_back(std::string(stage_names[i]) + ".cl");
    }
    return program_source(files, program);
}

/// PoCL's compiled kernels are for one size of work-group.
std::string program_key(const Device& device, const ProgramSource& source, int work_group_size) {
    return fmt::format("work-groups of {}\n", work_group_size) + source.key(device);
}

/// A program to be had.
struct Wanted {
    ProgramGroup group{};
    ProgramSource source;
    std::string key;
    bool opened = false; ///< among the device's programs
    bool kept = false;   ///< a process before this one had it, and the driver keeps it
};

Wanted wanted(const RenderDevice& d, ProgramGroup group, const StageOptions& options) {
    Wanted w{group, group_source(group, options), {}};
    w.key = program_key(d.device, w.source, options.work_group_size);
    w.opened = d.programs.contains(w.key);
    // An entry without a binary: the driver has the program.
    w.kept = d.device.keeps_programs && d.cache.load(w.key).has_value();
    return w;
}

struct Compiled {
    Program program;
    bool cached = false;
    double seconds = 0.0;
    std::uint64_t beside_peak_bytes = 0;
};

void check_work_group(std::size_t most, int work_group_size, const std::string& taker) {
    if (static_cast<std::size_t>(work_group_size) > most)
        throw InputError(fmt::format("--work-group-size {}: {} takes groups of 1 to {}",
                                     work_group_size, taker, most));
}

/// Some drivers finish compiling a kernel at its first launch (PoCL: for that size of work-group):
/// a launch without paths belongs to compiling.
void launch_empty(const RenderDevice& d, const Wanted& w, const Program& program,
                  const StageOptions& options) {
    int work_group_size = options.work_group_size;
    Buffer<ulong> zeros(d.context, "zeros",
                        static_cast<std::size_t>(statistic_count) * work_group_size);
    zeros.fill_zero(d.queue);
    for (std::size_t stage = 0; stage < stage_count; stage++) {
        if (stage_groups[stage] != w.group) continue;
        cl::Kernel kernel = program.kernel(stage_names[stage]);
        check_work_group(kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(d.device.handle),
                         work_group_size, fmt::format("kernel {}", stage_names[stage]));
        for (cl_uint i = 0; i < buffer_arguments; i++)
            kernel.setArg(i, zeros.handle());
        kernel.setArg(params_argument, RenderParams{});
        kernel.setArg(wave_argument, WaveParams{});
        kernel.setArg(depth_argument, 0);
        if (options.checked) {
            kernel.setArg(sizes_argument, BufferSizes{});
            kernel.setArg(outside_argument, zeros.handle());
        }
        d.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(work_group_size),
                                     cl::NDRange(work_group_size));
    }
    d.queue.finish();
}

/// After `beside`, which may be compiling the same, has ended.
Compiled compile(const RenderDevice& d, const Wanted& w, const StageOptions& options,
                 std::optional<ChildProcess> beside) {
    auto start = Clock::now();
    if (w.opened) return {d.programs.at(w.key), true};
    std::uint64_t beside_bytes = beside ? beside->wait().peak_bytes : 0;
    Program program(d.context, d.device, d.program_cache(), w.source);
    launch_empty(d, w, program, options);
    return {program, w.kept || program.from_cache(), seconds_since(start), beside_bytes};
}

/// Compiles the last program in another process, where another is to be compiled here: PoCL
/// compiles one program at a time in a process.
std::optional<ChildProcess> start_beside(const RenderDevice& d, const std::vector<Wanted>& programs,
                                         const StageOptions& options) {
    auto unknown = [](const Wanted& w) { return !w.opened && !w.kept; };
    if (!d.compile_beside || options.checked || !d.device.keeps_programs ||
        !unknown(programs.back()) || std::count_if(programs.begin(), programs.end(), unknown) < 2)
        return std::nullopt;
    return d.compile_beside(programs.back().group, options);
}

void keep(const RenderDevice& d, const Wanted& w, const Compiled& compiled) {
    if (compiled.cached) return;
    if (d.device.keeps_programs)
        d.cache.store(w.key, {});
    else
        compiled.program.store(d.cache);
}

StageReport stage_report(std::size_t stage, const StageOptions& options, const Compiled& compiled) {
    StageReport report;
    report.name = stage_names[stage];
    report.features = feature_names(options.features & stage_features(static_cast<Stage>(stage)));
    report.compile_seconds = compiled.seconds;
    report.cached = compiled.cached;
    return report;
}

} // namespace

StagePrograms compile_stages(RenderDevice& d, const StageOptions& options) {
    check_work_group(largest_work_group(d.device), options.work_group_size, d.device.name);
    std::vector<Wanted> programs;
    programs.reserve(program_groups.size());
    for (ProgramGroup group : program_groups)
        programs.push_back(wanted(d, group, options));
    std::optional<ChildProcess> beside = start_beside(d, programs, options);
    std::vector<std::future<Compiled>> jobs;
    jobs.reserve(programs.size());
    for (const Wanted& w : programs)
        jobs.push_back(
            std::async(d.device.one_thread ? std::launch::deferred : std::launch::async, compile,
                       std::cref(d), std::cref(w), std::cref(options),
                       &w == &programs.back() ? std::exchange(beside, {}) : std::nullopt));
    std::vector<Compiled> compiled;
    compiled.reserve(jobs.size());
    for (auto& job : jobs)
        compiled.push_back(job.get());
    StagePrograms result;
    result.checked = options.checked;
    for (std::size_t g = 0; g < compiled.size(); g++) {
        keep(d, programs[g], compiled[g]);
        d.programs.emplace(programs[g].key, compiled[g].program);
        result.beside_peak_bytes =
            std::max(result.beside_peak_bytes, compiled[g].beside_peak_bytes);
    }
    for (std::size_t i = 0; i < stage_count; i++) {
        const Compiled& c = compiled[static_cast<std::size_t>(stage_groups[i])];
        result.programs.push_back(c.program);
        result.reports.push_back(stage_report(i, options, c));
    }
    return result;
}

bool compile_program(RenderDevice& d, ProgramGroup group, const StageOptions& options) {
    check_work_group(largest_work_group(d.device), options.work_group_size, d.device.name);
    Wanted w = wanted(d, group, options);
    Compiled compiled = compile(d, w, options, std::nullopt);
    keep(d, w, compiled);
    d.programs.emplace(w.key, compiled.program);
    return compiled.cached;
}

} // namespace parhelion
