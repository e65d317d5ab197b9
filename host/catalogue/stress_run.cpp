// Counts, progress and programs of a stress run.
#include "host/catalogue/stress_run.h"

#include "host/numerics/probe_kernel.h"
#include "host/numerics/traversal.h"
#include "host/waves/render_device.h"

#include <map>
#include <mutex>
#include <optional>

namespace parhelion::stress {

struct StressRun::Kept {
    Progress& progress;
    std::mutex talking;
    std::map<std::string, Program> programs;
    std::optional<Traversal> traversal;
};

StressRun::StressRun(RenderDevice& d, const KernelWay& k, Effort e, std::uint64_t s,
                     Progress& progress)
    : device(d), kernels(k), effort(e), seed(s), kept_(new Kept{progress, {}, {}, {}}) {}

std::uint64_t StressRun::count(std::uint64_t brief, std::uint64_t quick, std::uint64_t full) const {
    return effort == Effort::brief ? brief : effort == Effort::quick ? quick : full;
}

StressRun::~StressRun() {
    for (const auto& [file, program] : kept_->programs)
        program.store(device.cache);
}

bool StressRun::usual_kernels() const {
    return kernels.lanes == device.device.lanes() && !kernels.portable;
}

void StressRun::done(double fraction) {
    std::lock_guard lock(kept_->talking);
    kept_->progress.update(fraction);
}

const Program& StressRun::program(const std::string& file) {
    auto& programs = kept_->programs;
    auto found = programs.find(file);
    if (found == programs.end())
        found = programs.emplace(file, stress_program(device, file, kernels)).first;
    return found->second;
}

Traversal& StressRun::traversal() {
    auto& traversal = kept_->traversal;
    if (!traversal)
        traversal.emplace(device,
                          ProgramOptions{.lanes = kernels.lanes, .portable = kernels.portable},
                          usual_kernels() ? count(1, 32, 64) : 0);
    return *traversal;
}

} // namespace parhelion::stress
