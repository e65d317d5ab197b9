// Compiling the stages' programs, side by side, and what was compiled before not again.
#include "host/waves/stage_programs.h"

#include "host/cl/buffer.h"
#include "host/cl/driver_watch.h"
#include "host/cl/queue_end.h"
#include "host/cl/work_groups.h"
#include "host/clock.h"
#include "host/error.h"
#include "host/waves/kernel_arguments.h"
#include "kernels/device/bounds.h"

#include <sys/types.h> // ulong, as the kernels call it

#include <algorithm>
#include <chrono>
#include <future>
#include <optional>

namespace parhelion {
namespace {

ProgramSource group_source(ProgramGroup group, const StageOptions& options) {
    // Intrinsics have no bounds.
    ProgramOptions program{
        lanes_of(group, options), {}, options.portable || options.checked, options.checked};
    std::vector<std::string> files;
    for (std::size_t i = 0; i < stage_count; i++) {
        if (stage_groups[i] != group) continue;
        program.features =
            program.features |
            (options.features & stage_features(static_cast<Stage>(i), options.features));
        files.push_back(std::string(stage_names[i]) + ".cl");
    }
    return program_source(files, program);
}

/// A program to be had.
struct Wanted {
    ProgramGroup group{};
    ProgramSource source;
    std::string key;
    bool opened = false; ///< among the device's programs
    bool kept = false;   ///< in the cache, as it seems
};

Wanted wanted(const RenderDevice& d, ProgramGroup group, const StageOptions& options) {
    Wanted w{group, group_source(group, options), {}};
    // PoCL's compiled kernels are for one size of work-group.
    w.source.use = fmt::format("work-groups of {}", options.work_group_size);
    w.key = w.source.key(d.device);
    w.opened = d.programs.contains(w.key);
    w.kept = d.cache.contains(w.key);
    return w;
}

struct Compiled {
    Program program;
    bool cached = false;
    double seconds = 0.0;
    std::vector<std::string> notes{}; ///< may be empty ones
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
    const QueueEnd end(d.queue);
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

/// How long to wait for a program that is compiled beside: as long as this process took for its
/// own, many times over, since both may find the machine busy.
std::chrono::milliseconds patience(Clock::time_point start) {
    return std::chrono::seconds(60) +
           std::chrono::milliseconds(static_cast<std::int64_t>(1e4 * seconds_since(start)));
}

/// Waits for the process that compiles `w` beside this one. A program that it leaves is found in
/// the cache; where it fails, this process compiles it, and says what became of the other.
ChildProcess::End finished(ChildProcess& beside, const Wanted& w, Clock::time_point start,
                           std::vector<std::string>& notes) {
    ChildProcess::End end = beside.wait(patience(start));
    if (!end.succeeded)
        notes.push_back(fmt::format("a second process to compile {} {}; compiled in this one",
                                    w.source.name, end.text()));
    return end;
}

/// The kernels are ready to run; what is compiled is kept.
Compiled compile(const RenderDevice& d, const Wanted& w, const StageOptions& options) {
    auto start = Clock::now();
    if (w.opened) return {d.programs.at(w.key), true};
    std::optional<Program> program;
    watch_driver("compiling kernels", [&] {
        program.emplace(d.context, d.device, d.cache, w.source);
        launch_empty(d, w, *program, options);
    });
    std::string note = program->store(d.cache);
    return {*program, program->from_cache(), seconds_since(start), {program->note(), note}};
}

bool is_unknown(const Wanted& w) { return !w.opened && !w.kept; }

/// Starts a process that compiles a program for this one, where that can be.
std::optional<ChildProcess> start_for(const RenderDevice& d, const Wanted& w,
                                      const StageOptions& options) {
    if (!d.compile_beside || options.checked || !d.device.keeps_programs || !is_unknown(w))
        return std::nullopt;
    return d.compile_beside(w.group, options, d.cache.open_folder());
}

/// Compiles the last program in another process, where another is to be compiled here: PoCL
/// compiles one program at a time in a process.
std::optional<ChildProcess> start_beside(const RenderDevice& d, const std::vector<Wanted>& programs,
                                         const StageOptions& options) {
    if (d.saves_memory || std::count_if(programs.begin(), programs.end(), is_unknown) < 2)
        return std::nullopt;
    return start_for(d, programs.back(), options);
}

/// Where the driver can do more than one thing at a time, all at once. PoCL cannot: it compiles one
/// program at a time, and its device `basic` waits for ever when two threads launch kernels that
/// are not yet compiled.
std::launch policy(const Device& device) {
    return device.one_thread || device.keeps_programs ? std::launch::deferred : std::launch::async;
}

/// Notes that are not there yet; an empty one is none.
void add_notes(std::vector<std::string>& notes, const std::vector<std::string>& more) {
    for (const std::string& note : more)
        if (!note.empty() && std::find(notes.begin(), notes.end(), note) == notes.end())
            notes.push_back(note);
}

StageReport stage_report(std::size_t stage, const StageOptions& options, const Compiled& compiled) {
    StageReport report;
    report.name = stage_names[stage];
    report.features =
        (options.features & stage_features(static_cast<Stage>(stage), options.features)).names();
    report.compile_seconds = compiled.seconds;
    report.cached = compiled.cached;
    return report;
}

} // namespace

StagePrograms compile_stages(RenderDevice& d, const StageOptions& options) {
    check_work_group(largest_work_group(d.device), options.work_group_size, d.device.name);
    auto start = Clock::now();
    std::vector<Wanted> programs;
    programs.reserve(program_groups.size());
    for (ProgramGroup group : program_groups)
        programs.push_back(wanted(d, group, options));
    std::optional<ChildProcess> beside = start_beside(d, programs, options);
    StagePrograms result;
    result.checked = options.checked;
    std::vector<std::future<Compiled>> jobs;
    jobs.reserve(programs.size());
    for (const Wanted& w : programs)
        jobs.push_back(std::async(policy(d.device), [&] {
            const bool is_beside = beside && &w == &programs.back();
            // A compiler's memory stays with the process that it was in.
            std::optional<ChildProcess> own;
            if (d.saves_memory) own = start_for(d, w, options);
            if (ChildProcess* process = is_beside ? &*beside : own ? &*own : nullptr) {
                const auto end = finished(*process, w, start, result.notes);
                result.beside_peak_bytes = std::max(result.beside_peak_bytes, end.peak_bytes);
            }
            return compile(d, w, options);
        }));
    std::vector<Compiled> compiled;
    compiled.reserve(jobs.size());
    for (auto& job : jobs)
        compiled.push_back(job.get());
    for (std::size_t g = 0; g < compiled.size(); g++) {
        d.programs.emplace(programs[g].key, compiled[g].program);
        add_notes(result.notes, compiled[g].notes);
    }
    for (std::size_t i = 0; i < stage_count; i++) {
        const Compiled& c = compiled[static_cast<std::size_t>(stage_groups[i])];
        result.programs.push_back(c.program);
        result.reports.push_back(stage_report(i, options, c));
    }
    return result;
}

bool compile_program(RenderDevice& d, ProgramGroup group, const StageOptions& options,
                     std::vector<std::string>& notes) {
    check_work_group(largest_work_group(d.device), options.work_group_size, d.device.name);
    Wanted w = wanted(d, group, options);
    Compiled compiled = compile(d, w, options);
    d.programs.emplace(w.key, compiled.program);
    add_notes(notes, compiled.notes);
    return compiled.cached;
}

} // namespace parhelion
