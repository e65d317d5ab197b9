// Compiling the stages' programs, side by side, and what was compiled before not again.
#include "host/render/stage_programs.h"

#include "host/cl/buffer.h"
#include "host/clock.h"
#include "host/render/kernel_arguments.h"

#include <sys/types.h> // ulong, as the kernels call it

#include <future>

namespace parhelion {
namespace {

ProgramSource group_source(ProgramGroup group, const StageOptions& options) {
    ProgramOptions program{options.lanes, 0, options.portable};
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

struct Compiled {
    Program program;
    bool cached;
    double seconds;
};

Compiled compile_group(const RenderDevice& d, const ProgramSource& source, const std::string& key) {
    auto start = Clock::now();
    if (auto found = d.programs.find(key); found != d.programs.end())
        return {found->second, true, seconds_since(start)};
    if (!d.device.keeps_programs) {
        Program program(d.context, d.device, d.cache, source);
        return {program, program.from_cache(), seconds_since(start)};
    }
    // An entry without a binary: the driver has the program.
    bool known = d.cache.load(key).has_value();
    return {Program(d.context, d.device, ProgramCache({}), source), known, seconds_since(start)};
}

/// Some drivers finish compiling a kernel at its first launch (PoCL: for that size of work-group):
/// a launch without paths belongs to compiling.
void launch_empty(const RenderDevice& d, std::vector<cl::Kernel>& kernels, int work_group_size) {
    Buffer<ulong> zeros(d.context, "zeros",
                        static_cast<std::size_t>(statistic_count) * work_group_size);
    zeros.fill_zero(d.queue);
    for (cl::Kernel& kernel : kernels) {
        for (cl_uint i = 0; i < buffer_arguments; i++)
            kernel.setArg(i, zeros.handle());
        kernel.setArg(params_argument, RenderParams{});
        kernel.setArg(wave_argument, WaveParams{});
        kernel.setArg(depth_argument, 0);
        d.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(work_group_size),
                                     cl::NDRange(work_group_size));
    }
    d.queue.finish();
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
    StagePrograms result;
    std::vector<std::future<Compiled>> jobs;
    for (ProgramGroup group : program_groups) {
        ProgramSource source = group_source(group, options);
        result.keys.push_back(program_key(d.device, source, options.work_group_size));
        jobs.push_back(std::async(std::launch::async, compile_group, std::cref(d), source,
                                  result.keys.back()));
    }
    std::vector<Compiled> compiled;
    compiled.reserve(jobs.size());
    for (auto& job : jobs)
        compiled.push_back(job.get());
    for (std::size_t i = 0; i < stage_count; i++) {
        const Compiled& c = compiled[static_cast<std::size_t>(stage_groups[i])];
        result.kernels.push_back(c.program.kernel(stage_names[i]));
        result.reports.push_back(stage_report(i, options, c));
    }
    bool first_use = false;
    for (std::size_t g = 0; g < compiled.size(); g++)
        first_use |= d.programs.emplace(result.keys[g], compiled[g].program).second;
    if (first_use) launch_empty(d, result.kernels, options.work_group_size);
    for (std::size_t g = 0; g < compiled.size(); g++)
        if (d.device.keeps_programs && !compiled[g].cached) d.cache.store(result.keys[g], {});
    return result;
}

void store_programs(const RenderDevice& d, const StagePrograms& stages) {
    if (d.device.keeps_programs) return;
    for (const std::string& key : stages.keys)
        d.programs.at(key).store(d.cache);
}

} // namespace parhelion
