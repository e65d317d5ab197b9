// Counts, progress and programs of a stress run.
#include "host/catalogue/stress_run.h"

#include "host/numerics/probes.h"

namespace parhelion::stress {

std::uint64_t StressRun::count(std::uint64_t brief, std::uint64_t quick, std::uint64_t full) const {
    return effort == Effort::brief ? brief : effort == Effort::quick ? quick : full;
}

StressRun::~StressRun() {
    for (const auto& [file, program] : programs_)
        program.store(device.cache);
}

bool StressRun::usual_kernels() const {
    return kernels.lanes == device.device.lanes() && !kernels.portable;
}

void StressRun::done(double fraction) {
    std::lock_guard lock(talking_);
    progress_.update(fraction, "");
}

const Program& StressRun::program(const std::string& file) {
    auto found = programs_.find(file);
    if (found == programs_.end())
        found = programs_.emplace(file, stress_program(device, file, kernels)).first;
    return found->second;
}

Traversal& StressRun::traversal() {
    if (!traversal_)
        traversal_.emplace(device,
                           ProgramOptions{.lanes = kernels.lanes, .portable = kernels.portable},
                           usual_kernels() ? count(1, 32, 64) : 0);
    return *traversal_;
}

} // namespace parhelion::stress
