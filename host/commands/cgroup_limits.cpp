// What control groups allow this process.
#include "host/commands/machine.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace parhelion {
namespace fs = std::filesystem;
namespace {

/// A number at the start of a file; none where it says "max", or -1.
std::optional<double> number_in(const fs::path& file) {
    std::ifstream in(file);
    double value = 0;
    if (!(in >> value) || value < 0) return std::nullopt;
    return value;
}

/// "QUOTA PERIOD" in microseconds.
std::optional<double> processors_in(const fs::path& file) {
    std::ifstream in(file);
    double quota = 0, period = 0;
    if (!(in >> quota >> period) || period <= 0) return std::nullopt;
    return quota / period;
}

template<class T>
void lower(std::optional<T>& limit, const std::optional<T>& other) {
    if (other) limit = limit ? std::min(*limit, *other) : *other;
}

void lower_memory(CgroupLimits& limits, const fs::path& file) {
    // Version 1 says "none" by a number that no machine has.
    constexpr double none = 1e18;
    const std::optional<double> bytes = number_in(file);
    if (bytes && *bytes < none)
        lower(limits.memory_bytes, std::optional(static_cast<std::uint64_t>(*bytes)));
}

void lower_by_group(CgroupLimits& limits, const fs::path& folder) {
    lower(limits.processors, processors_in(folder / "cpu.max"));
    lower_memory(limits, folder / "memory.max");
    const auto quota = number_in(folder / "cpu.cfs_quota_us"),
               period = number_in(folder / "cpu.cfs_period_us");
    if (quota && period && *period > 0) lower(limits.processors, std::optional(*quota / *period));
    lower_memory(limits, folder / "memory.limit_in_bytes");
}

/// The group and all above it: a group's limit holds for those in it.
void lower_by_groups(CgroupLimits& limits, const fs::path& mounted, fs::path group) {
    for (;; group = group.parent_path()) {
        lower_by_group(limits, mounted / group.relative_path());
        if (group == group.parent_path()) return;
    }
}

} // namespace

CgroupLimits cgroup_limits(const fs::path& root) {
    CgroupLimits limits;
    const fs::path mounted = root / "sys/fs/cgroup";
    std::ifstream in(root / "proc/self/cgroup");
    for (std::string line; std::getline(in, line);) { // "NUMBER:CONTROLLERS:/GROUP"
        std::istringstream parts(line);
        std::string number, controllers, group;
        if (!std::getline(parts, number, ':') || !std::getline(parts, controllers, ':') ||
            !std::getline(parts, group))
            continue;
        if (controllers.empty()) lower_by_groups(limits, mounted, group);
        std::istringstream names(controllers);
        for (std::string name; std::getline(names, name, ',');)
            if (name == "cpu" || name == "memory") lower_by_groups(limits, mounted / name, group);
    }
    return limits;
}

} // namespace parhelion
