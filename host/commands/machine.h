// What the machine is and what of it this process may use.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace parhelion {

/// What control groups allow; absent: no limit.
struct CgroupLimits {
    std::optional<double> processors{};
    std::optional<std::uint64_t> memory_bytes{};
};

/// Those of this process, of all groups above it, versions 2 and 1. `root`: the folder in which
/// proc and sys lie.
CgroupLimits cgroup_limits(const std::filesystem::path& root = "/");

struct Machine {
    std::string system{}, kernel{}; ///< "Debian GNU/Linux 12 (bookworm)", "Linux 6.1.0 x86_64"
    std::string processor{};
    int processors = 0, usable_processors = 0; ///< on line; this process may run on
    std::uint64_t memory_bytes = 0, free_memory_bytes = 0;
    std::optional<std::uint64_t> address_space_bytes{}; ///< ulimit -v
    CgroupLimits cgroup{};
};

/// What cannot be found out stays empty.
Machine this_machine();

} // namespace parhelion
