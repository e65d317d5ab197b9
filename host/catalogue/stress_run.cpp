// Counts, progress and programs of a stress run.
#include "host/catalogue/stress_run.h"

#include "host/numerics/probes.h"

namespace parhelion::stress {

std::uint64_t StressRun::count(std::uint64_t test, std::uint64_t quick, std::uint64_t full) const {
    return effort == Effort::test ? test : effort == Effort::quick ? quick : full;
}

StressRun::~StressRun() {
    for (const auto& [file, program] : programs_)
        program.store(device.cache);
}

void StressRun::done(double fraction) {
    std::lock_guard lock(talking_);
    progress_.update(fraction, "");
}

const Program& StressRun::program(const std::string& file) {
    auto found = programs_.find(file);
    if (found == programs_.end())
        found = programs_.emplace(file, stress_program(device, file, device.device.lanes(), false))
                    .first;
    return found->second;
}

Traversal& StressRun::traversal() {
    if (!traversal_)
        traversal_.emplace(device, ProgramOptions{.lanes = device.device.lanes()},
                           count(1, 32, 64));
    return *traversal_;
}

} // namespace parhelion::stress
